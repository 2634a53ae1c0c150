// SPDX-License-Identifier: Apache-2.0
#include "scene/read_curves.h"

#include <fmt/format.h>

#include <utility>

#include "pdsm/format/error.h"
#include "scene/format_fault.h"
#include "scene/hair_import.h"
#include "scene/one_line.h"
#include "scene/read_placement.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

CurveShape read_shape(const JsonFields& fields) {
  if (!fields.has("shape")) return CurveShape::round;
  const std::string name = fields.text("shape");
  if (name != "round" && name != "flat") fields.refuse("shape", "must be \"round\" or \"flat\"");
  return name == "round" ? CurveShape::round : CurveShape::flat;
}

ImportedHair import(const JsonFields& fields, const fs::path& path, FileSource& files) {
  try {
    return import_hair(files.read_unpacked(path));
  } catch (const Error& fault) {
    throw Error(fault.failure(), fields.file() + ":" + fields.path_of("file"), fault.what());
  } catch (const FormatFault& fault) {
    fields.refuse("file", path.string() + ": " + one_line(fault.what()));
  }
}

}  // namespace

void read_curves(const JsonFields& fields, const fs::path& folder, FileSource& files, Scene& scene) {
  fields.allow_only({"file", "shape", "scale", "rotate", "translate", "casts"});
  const std::string file = fields.text("file");
  if (file.empty() || file.find('\0') != std::string::npos) fields.refuse("file", "must name a file");
  Curves curves;
  curves.name = one_line(file);
  curves.shape = read_shape(fields);
  curves.local_to_world = read_placement(fields);
  curves.casts = !fields.has("casts") || fields.boolean("casts");
  ImportedHair hair = import(fields, folder / fs::path(file), files);
  if (hair.left_out > 0)
    scene.warnings.push_back(fmt::format("{}: {} segments without finite ends or without width left out",
                                         curves.name, hair.left_out));
  if (hair.strands.segments.empty()) {
    scene.warnings.push_back(curves.name + ": is empty, and casts nothing");
    return;
  }
  curves.strands = std::make_shared<const Strands>(std::move(hair.strands));
  try {
    check_curves(curves);
  } catch (const Error&) {
    // Of what is read, only the placement may be at fault.
    fields.refuse("scale", "must be one factor for all axes, as curves are round");
  }
  scene.curves.push_back(std::move(curves));
}

}  // namespace pdsm
