// SPDX-License-Identifier: Apache-2.0
#include "choose/quality.h"

namespace pdsm {

Settings quality_settings(Quality quality) {
  switch (quality) {
    case Quality::draft:
      return {64, 256, 256, 0.04};
    case Quality::final:
      return {1024, 2048, 2048, 0.01};
    case Quality::game:
      break;
  }
  const BakeOptions defaults;
  return settings_of(defaults);
}

}  // namespace pdsm
