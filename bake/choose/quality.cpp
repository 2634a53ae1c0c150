// SPDX-License-Identifier: Apache-2.0
#include "choose/quality.h"

namespace pdsm {

Settings quality_settings(Quality quality) {
  switch (quality) {
    case Quality::draft:
      return {64, 256, 256, 0.04};
    case Quality::final:
      return {512, 1024, 1024, 0.01, 2};
    case Quality::game:
      break;
  }
  const BakeOptions defaults;
  return settings_of(defaults);
}

}  // namespace pdsm
