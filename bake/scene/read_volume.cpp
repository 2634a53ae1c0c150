// SPDX-License-Identifier: Apache-2.0
#include "scene/read_volume.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "pdsm/format/error.h"
#include "scene/format_fault.h"
#include "scene/geometry_import.h"
#include "scene/one_line.h"
#include "scene/read_placement.h"
#include "scene/vdb_import.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

/// What an entry says besides its file's name.
struct VolumeEntry {
  std::string file, grid;
  glm::dmat4 placement{1.0};
  double extinction = 1;
  bool casts = true;
};

VolumeEntry read_entry(const JsonFields& fields) {
  fields.allow_only({"file", "grid", "extinction", "scale", "rotate", "translate", "casts"});
  VolumeEntry entry;
  entry.file = fields.text("file");
  if (entry.file.empty() || entry.file.find('\0') != std::string::npos)
    fields.refuse("file", "must name a file");
  entry.grid = fields.has("grid") ? fields.text("grid") : "density";
  if (fields.has("extinction")) entry.extinction = fields.not_negative("extinction");
  entry.placement = read_placement(fields);
  entry.casts = !fields.has("casts") || fields.boolean("casts");
  return entry;
}

ImportedGrid import_grid(const JsonFields& fields, const VolumeEntry& entry, const fs::path& path,
                         FileSource& files) {
  try {
    return import_vdb(files.read_unpacked(path), entry.grid);
  } catch (const Error& fault) {
    throw Error(fault.failure(), fields.file() + ":" + fields.path_of("file"), fault.what());
  } catch (const FormatFault& fault) {
    fields.refuse("file", path.string() + ": " + one_line(fault.what()));
  }
}

void add_volume(const JsonFields& fields, const ImportedGrid& imported, const VolumeEntry& entry,
                const std::string& name, Scene& scene) {
  if (imported.density->bricks.empty()) {
    scene.warnings.push_back(name + ": is empty, and casts nothing");
    return;
  }
  const Volume& volume = scene.volumes.emplace_back(Volume{
      name, imported.density, entry.placement * imported.index_to_file, entry.extinction, entry.casts});
  try {
    check_volume(volume);
  } catch (const Error& fault) {
    throw Error(fault.failure(), fields.file() + ":" + fields.path_of("file"), fault.what());
  }
}

void add_solid(const ImportedGrid& imported, const VolumeEntry& entry, const std::string& name,
               Scene& scene) {
  PartCollector parts(name);
  PartNames names;
  parts.add(names, parts.clean(*imported.solid, names), imported.index_to_file, {});
  ImportedFile solid = parts.take();
  if (solid.parts.empty()) scene.warnings.push_back(name + ": is empty, and casts nothing");
  place(solid.parts, entry.placement);
  for (Geometry& part : solid.parts) part.casts = entry.casts;
  std::ranges::move(solid.parts, std::back_inserter(scene.geometry));
}

}  // namespace

void read_volume(const JsonFields& fields, const fs::path& folder, FileSource& files, Scene& scene) {
  const VolumeEntry entry = read_entry(fields);
  const ImportedGrid imported = import_grid(fields, entry, folder / fs::path(entry.file), files);
  const std::string name = one_line(entry.file + ":" + entry.grid);
  if (imported.density) {
    add_volume(fields, imported, entry, name, scene);
    return;
  }
  if (fields.has("extinction"))
    fields.refuse("extinction", "is of densities, and " + name + " is a level set: a solid");
  add_solid(imported, entry, name, scene);
}

}  // namespace pdsm
