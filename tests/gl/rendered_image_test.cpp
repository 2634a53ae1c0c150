// SPDX-License-Identifier: Apache-2.0
// A floor, rasterised by GL with its baked shadow, against the same picture by viewing rays and look-ups.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "gl_program.h"
#include "gpu_look_up.h"
#include "pdsm/bake/bake.h"
#include "pdsm/bake/scene_file.h"

namespace pdsm {
namespace {

constexpr std::uint32_t kWidth = 320, kHeight = 240;

Scene plate_scene() {
  return read_scene(std::string(PDSM_EXAMPLES) + "/scenes/plate.scene.json");
}

PenumbraMap bake_plate(const Scene& scene, const Light& light) {
  BakeOptions options;
  options.width = options.height = 128;
  options.samples = 64;
  return decode_blocks(bake(scene, light, options));
}

glm::dmat4 picture_matrix() {
  return glm::perspective(glm::radians(45.0), static_cast<double>(kWidth) / kHeight, 0.1, 100.0) *
         glm::lookAt(glm::dvec3(2, 4, 5), glm::dvec3(0), glm::dvec3(0, 1, 0));
}

const char* const kVertex = R"(#version 330
uniform mat4 matrix;
out vec3 position;
void main() {
  position = vec3(8.0 * float(gl_VertexID & 1) - 4.0, 0.0, 8.0 * float(gl_VertexID >> 1) - 4.0);
  gl_Position = matrix * vec4(position, 1.0);
}
)";
const char* const kFragment = R"(
in vec3 position;
out float visibility;
void main() { visibility = pdsm_visibility(0, position, vec3(0.0, 1.0, 0.0)); }
)";

/// Visibility by pixel from the lower left; -1 where the floor is not.
std::vector<float> draw_floor(const PenumbraMap& map, TextureLayout layout, Filter filter) {
  const testing::EglContext context(testing::GlApi::core_33);
  ShadowTextures shadows(testing::EglContext::loader());
  const PenumbraMap* const maps[] = {&map};
  shadows.upload(maps, layout);
  shadows.set_look_up(0, {filter, 0});
  const testing::GlProgram program(kVertex, "#version 330\n" + shadows.shader_text() + kFragment);
  const testing::FloatTarget target(kWidth, kHeight, GL_R32F);
  glClearColor(-1, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  shadows.bind(program.name());
  glUseProgram(program.name());
  glUniformMatrix4fv(program.uniform("matrix"), 1, GL_FALSE, glm::value_ptr(glm::mat4(picture_matrix())));
  GLuint array = 0;
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glDeleteVertexArrays(1, &array);
  std::vector<float> pixels(std::size_t{kWidth} * kHeight);
  glReadPixels(0, 0, kWidth, kHeight, GL_RED, GL_FLOAT, pixels.data());
  return pixels;
}

/// Where the viewing ray through a point of the picture (pixels, lower left) meets y = 0.
glm::dvec3 floor_point(const glm::dmat4& to_world, double x, double y) {
  const glm::dvec2 ndc(2 * x / kWidth - 1, 2 * y / kHeight - 1);
  const auto at = [&](double z) {
    const glm::dvec4 p = to_world * glm::dvec4(ndc, z, 1);
    return glm::dvec3(p) / p.w;
  };
  const glm::dvec3 front = at(-1), back = at(1);
  return front + (back - front) * (front.y / (front.y - back.y));
}

void expect_picture_by_rays_and_look_ups(const PenumbraMap& map) {
  const PenumbraLookUp look_up(map);
  const glm::dmat4 to_world = glm::inverse(picture_matrix());
  // GL may snap vertices to a 256th of a pixel; so the picture may be moved by as much, and once more for the
  // rounding of what is interpolated.
  constexpr double kSnap = 2.0 / 256;
  const float quantum = 1 / static_cast<float>(map.coding.value_max);
  for (const TextureLayout layout : {TextureLayout::two_level, TextureLayout::fixed_depth}) {
    for (const Filter filter : {Filter::nearest, Filter::bilinear}) {
      const std::vector<float> pixels = draw_floor(map, layout, filter);
      std::size_t shown = 0, penumbra = 0;
      for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
          const float drawn = pixels[std::size_t{y} * kWidth + x];
          if (drawn < 0) continue;
          float low = 1, high = 0;
          for (int n = 0; n < 25; ++n) {
            const double dx = (n % 5 - 2) * kSnap / 2, dy = (n / 5 - 2) * kSnap / 2;
            const glm::dvec3 p = floor_point(to_world, x + 0.5 + dx, y + 0.5 + dy);
            const float visibility = 1 - look_up.at({p.x, p.y, p.z}, filter).attenuation;
            low = std::min(low, visibility);
            high = std::max(high, visibility);
          }
          ASSERT_GE(drawn, low - quantum) << x << ' ' << y;
          ASSERT_LE(drawn, high + quantum) << x << ' ' << y;
          ++shown;
          penumbra += drawn > 0.1F && drawn < 0.9F ? 1 : 0;
        }
      }
      EXPECT_GT(shown, pixels.size() / 2);
      EXPECT_GT(penumbra, pixels.size() / 50);
    }
  }
}

TEST(RenderedImage, AgreesWithThePictureByRaysAndLookUps) {
  const Scene scene = plate_scene();
  expect_picture_by_rays_and_look_ups(bake_plate(scene, scene.lights.front()));
}

/// An orthographic map.
TEST(RenderedImage, AgreesUnderADistantLight) {
  const Scene scene = plate_scene();
  Light sun;
  sun.shape = DistantLight{20};
  sun.direction = {0.3, -1, 0.2};
  place_distant_light(scene, sun);
  const PenumbraMap map = bake_plate(scene, sun);
  ASSERT_EQ(map.views.front().projection, Projection::orthographic);
  expect_picture_by_rays_and_look_ups(map);
}

}  // namespace
}  // namespace pdsm
