// SPDX-License-Identifier: Apache-2.0
// A bake within a program: meshes and light from memory, progress, cancelling, and blocks into a container of
// one's own as they finish.
//   bake_in_memory OUTPUT.pdsm [CANCEL_AT]      CANCEL_AT: share done, 0 .. 1, at which to stop
#include <cstdlib>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "pdsm/bake/stream.h"
#include "pdsm/format/error.h"
#include "pdsm/runtime/look_up.h"

namespace {

/// A square in the plane y = `height`, 2 x `half` metres wide.
std::shared_ptr<const pdsm::Mesh> make_square(float half, float height) {
  pdsm::Mesh mesh;
  mesh.positions = {
      {-half, height, -half}, {-half, height, half}, {half, height, half}, {half, height, -half}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.closed = pdsm::is_closed(mesh);
  return std::make_shared<const pdsm::Mesh>(std::move(mesh));
}

pdsm::Scene make_scene() {
  pdsm::Scene scene;
  pdsm::Geometry roof, floor;
  roof.name = "roof";
  roof.mesh = make_square(1, 2);
  floor.name = "floor";
  floor.mesh = make_square(6, 0);
  floor.casts = false;
  scene.geometry = {roof, floor};
  return scene;
}

pdsm::Light make_light() {
  pdsm::Light light;
  light.name = "lamp";
  light.shape = pdsm::RectLight{0.5, 0.5};
  light.position = {0, 5, 0};
  light.direction = {0, -1, 0};
  return light;
}

/// What a host may have: blocks in the order in which they came, and where to find each.
class Container {
 public:
  /// From several threads at once.
  void add(std::uint32_t image, std::uint32_t block, pdsm::EncodedBlock&& encoded) {
    const std::lock_guard guard(mutex_);
    places_[{image, block}] = blocks_.size();
    blocks_.push_back(std::move(encoded));
  }
  [[nodiscard]] const pdsm::EncodedBlock& get(std::uint32_t image, std::uint32_t block) const {
    return blocks_[places_.at({image, block})];
  }
  [[nodiscard]] std::size_t size() const { return blocks_.size(); }

 private:
  std::mutex mutex_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> places_;
  std::vector<pdsm::EncodedBlock> blocks_;
};

/// The map as a look-up wants it: every block out of the container, decoded.
pdsm::PenumbraMap unpack(pdsm::PenumbraMap map, const Container& container) {
  for (std::uint32_t n = 0; n < map.images.size(); ++n) {
    pdsm::FunctionImage& image = map.images[n];
    const std::uint32_t across = image.blocks_across();
    for (std::uint32_t b = 0; b < across * image.blocks_up(); ++b) {
      const auto [width, height] = pdsm::block_extent(image.width, image.height, b % across, b / across);
      image.blocks.push_back(pdsm::decode_block(map.coding, width, height, container.get(n, b)));
    }
  }
  return map;
}

void run(const char* output, double cancel_at) {
  Container container;
  double done = 0;
  pdsm::BakeCallbacks callbacks;
  callbacks.progress = [&done](const pdsm::BakeProgress& progress) {
    done = progress.done;
    std::cerr << progress.step << ' ' << static_cast<int>(100 * done) << "%\n";
  };
  callbacks.cancelled = [&] { return done >= cancel_at; };
  pdsm::BakeStream stream;
  stream.take = [&container](std::uint32_t image, std::uint32_t block, pdsm::EncodedBlock&& encoded) {
    container.add(image, block, std::move(encoded));
  };
  pdsm::BakeOptions options;
  options.mip_levels = 2;
  const pdsm::BakedMap baked = pdsm::bake_streamed(make_scene(), make_light(), options, stream, callbacks);

  const pdsm::PenumbraMap map = unpack(baked.map, container);
  const pdsm::PenumbraLookUp look_up(map);
  const auto blocked = [&](double x) { return look_up.at({x, 0.5, 0}, pdsm::Filter::bilinear).attenuation; };
  std::cout << container.size() << " blocks, " << baked.report.pieces << " pieces; below " << blocked(0)
            << ", beside " << blocked(4) << '\n';
  pdsm::write_map(map, output);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: bake_in_memory OUTPUT.pdsm [CANCEL_AT]\n";
    return 2;
  }
  try {
    run(argv[1], argc > 2 ? std::strtod(argv[2], nullptr) : 2);
  } catch (const pdsm::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.failure());
  }
}
