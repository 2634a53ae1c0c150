// SPDX-License-Identifier: Apache-2.0
#include "gpu_look_up.h"

#include <bit>

#include "gl_program.h"

namespace pdsm::testing {
namespace {

/// Points go in, and bits come out, through textures of this width.
constexpr std::uint32_t kWidth = 512;

/// A texture of positions, one texel a point.
class PointTexture {
 public:
  PointTexture(const std::vector<FloatPoint>& points, std::uint32_t rows) {
    std::vector<float> texels(std::size_t{4} * kWidth * rows);
    for (std::size_t n = 0; n < points.size(); ++n)
      std::copy(points[n].begin(), points[n].end(), texels.begin() + static_cast<std::ptrdiff_t>(4 * n));
    glGenTextures(1, &name_);
    glBindTexture(GL_TEXTURE_2D, name_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, kWidth, static_cast<GLsizei>(rows), 0, GL_RGBA, GL_FLOAT,
                 texels.data());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
      glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  }
  ~PointTexture() { glDeleteTextures(1, &name_); }
  PointTexture(const PointTexture&) = delete;
  PointTexture& operator=(const PointTexture&) = delete;
  [[nodiscard]] GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
};

}  // namespace

std::string version_line(GlApi api) {
  if (api == GlApi::es_30) return "#version 300 es\n";
  return api == GlApi::core_45 ? "#version 450\n" : "#version 330\n";
}

std::vector<float> gpu_look_up(ShadowTextures& shadows, GlApi api, std::uint32_t map,
                               const std::vector<FloatPoint>& points, const std::string& expression,
                               ShaderScope scope) {
  const std::string fragment = version_line(api) + shadows.shader_text(scope) + R"(
uniform highp sampler2D points;
uniform int map;
out uvec4 bits;
void main() {
  vec3 position = texelFetch(points, ivec2(gl_FragCoord.xy), 0).xyz;
  vec3 normal = vec3(0.0);
  bits = uvec4(floatBitsToUint()" +
                               expression + R"(), 0u, 0u, 0u);
}
)";
  const auto rows = static_cast<std::uint32_t>((points.size() + kWidth - 1) / kWidth);
  const GlProgram program(target_vertex_shader(version_line(api)), fragment);
  const PointTexture point_texture(points, rows);
  const FloatTarget target(kWidth, rows, GL_RGBA32UI);
  shadows.bind(program.name());
  glUseProgram(program.name());
  glActiveTexture(GL_TEXTURE0 + 5);
  glBindTexture(GL_TEXTURE_2D, point_texture.name());
  glUniform1i(program.uniform("points"), 5);
  glUniform1i(program.uniform("map"), static_cast<GLint>(map));
  draw_target();
  std::vector<std::uint32_t> bits(std::size_t{4} * kWidth * rows);
  glReadPixels(0, 0, kWidth, static_cast<GLsizei>(rows), GL_RGBA_INTEGER, GL_UNSIGNED_INT, bits.data());
  std::vector<float> values;
  for (std::size_t n = 0; n < points.size(); ++n) values.push_back(std::bit_cast<float>(bits[4 * n]));
  return values;
}

}  // namespace pdsm::testing
