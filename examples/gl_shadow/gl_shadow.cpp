// SPDX-License-Identifier: Apache-2.0
// The smallest GL program that shows a baked shadow: a screen that moves from the light to the far end of the
// map and back.
//   gl_shadow MAP.pdsm               in a window
//   gl_shadow MAP.pdsm PICTURE.ppm   one picture of the far end, without a window
#include <epoxy/gl.h>

#include <GLFW/glfw3.h>
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"
#include "pdsm/runtime/shadow_textures.h"

constexpr int kEdge = 512;  // pixels

// The library's text comes between the version and this.
const char* const kFragment = R"(
uniform vec4 window;         // of the map, tangents
uniform float depth;         // of the screen, metres
uniform mat4x3 view_to_world;
uniform vec2 pixels;
out vec4 colour;
void main() {
  vec2 slope = mix(window.xy, window.zw, gl_FragCoord.xy / pixels);
  vec3 position = view_to_world * vec4(slope * depth, depth, 1.0);
  colour = vec4(vec3(pdsm_visibility(0, position, vec3(0.0))), 1.0);
}
)";
const char* const kVertex = R"(
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(4.0 * corner - 1.0, 0.0, 1.0);
}
)";

GLuint compile(GLuint program, GLenum stage, const std::string& text) {
  const GLuint shader = glCreateShader(stage);
  const char* source = text.c_str();
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  glAttachShader(program, shader);
  return shader;
}

GLuint link_program(const pdsm::ShadowTextures& shadows) {
  const GLuint program = glCreateProgram();
  const std::string version = "#version 330\n";
  compile(program, GL_VERTEX_SHADER, version + kVertex);
  compile(program, GL_FRAGMENT_SHADER,
          version + shadows.shader_text(pdsm::ShaderScope::these_maps) + kFragment);
  glLinkProgram(program);
  GLint linked = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == 0) throw pdsm::Error(pdsm::Failure::resource, "OpenGL", "the program does not link");
  return program;
}

/// Inverse of the view's rigid motion, column by column.
std::array<float, 12> view_to_world(const pdsm::View& view) {
  const auto& r = view.world_to_view.rotation;
  const auto& t = view.world_to_view.translation;
  std::array<float, 12> columns{};
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t n = 0; n < 3; ++n) columns[3 * n + a] = static_cast<float>(r[3 * n + a]);
    columns[9 + a] = static_cast<float>(-(r[a] * t[0] + r[3 + a] * t[1] + r[6 + a] * t[2]));
  }
  return columns;
}

void draw(GLuint program, pdsm::ShadowTextures& shadows, const pdsm::View& view, double depth, int width,
          int height) {
  glViewport(0, 0, width, height);
  shadows.bind(program);
  glUseProgram(program);
  const auto& w = view.window;
  glUniform4f(glGetUniformLocation(program, "window"), static_cast<float>(w[0]), static_cast<float>(w[1]),
              static_cast<float>(w[2]), static_cast<float>(w[3]));
  glUniform1f(glGetUniformLocation(program, "depth"), static_cast<float>(depth));
  glUniform2f(glGetUniformLocation(program, "pixels"), static_cast<float>(width), static_cast<float>(height));
  glUniformMatrix4x3fv(glGetUniformLocation(program, "view_to_world"), 1, GL_FALSE,
                       view_to_world(view).data());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void write_picture(const std::string& path) {
  std::vector<char> pixels(std::size_t{3} * kEdge * kEdge);
  glReadPixels(0, 0, kEdge, kEdge, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << kEdge << ' ' << kEdge << "\n255\n";
  file.write(pixels.data(), static_cast<std::streamsize>(pixels.size()));
  if (!file.flush()) throw pdsm::Error(pdsm::Failure::resource, path, "can't be written");
}

void run(const std::string& map_path, const std::string& picture_path) {
  const pdsm::PenumbraMap map = pdsm::read_map(map_path);
  if (glfwInit() == GLFW_FALSE) throw pdsm::Error(pdsm::Failure::resource, "GLFW", "there is no display");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_VISIBLE, picture_path.empty() ? GLFW_TRUE : GLFW_FALSE);
  GLFWwindow* window = glfwCreateWindow(kEdge, kEdge, map_path.c_str(), nullptr, nullptr);
  if (window == nullptr) throw pdsm::Error(pdsm::Failure::resource, "GLFW", "there is no OpenGL 3.3");
  glfwMakeContextCurrent(window);

  pdsm::ShadowTextures shadows(
      [](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); });
  const pdsm::PenumbraMap* const maps[] = {&map};
  shadows.upload(maps);
  const GLuint program = link_program(shadows);
  GLuint no_vertices = 0;
  glGenVertexArrays(1, &no_vertices);
  glBindVertexArray(no_vertices);

  const pdsm::View& view = map.views.front();
  if (!picture_path.empty()) {
    draw(program, shadows, view, view.far_depth, kEdge, kEdge);
    write_picture(picture_path);
  }
  while (picture_path.empty() && glfwWindowShouldClose(window) == GLFW_FALSE) {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window, &width, &height);
    const double share = 0.5 - 0.5 * std::cos(glfwGetTime());
    draw(program, shadows, view, std::lerp(view.near_depth, view.far_depth, share), width, height);
    glfwSwapBuffers(window);
    glfwPollEvents();
  }
}

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    std::cerr << "usage: gl_shadow MAP.pdsm [PICTURE.ppm]\n";
    return 2;
  }
  int status = 0;
  try {
    run(argv[1], argc == 3 ? argv[2] : "");
  } catch (const pdsm::Error& error) {
    std::cerr << error.what() << '\n';
    status = static_cast<int>(error.failure());
  }
  glfwTerminate();
  return status;
}
