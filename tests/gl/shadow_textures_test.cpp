// SPDX-License-Identifier: Apache-2.0
#include "pdsm/runtime/shadow_textures.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "gl_program.h"
#include "gpu_look_up.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

using testing::EglContext;
using testing::GlApi;
using testing::MapShape;
using testing::random_map;

PenumbraMap small_map(std::uint64_t seed) {
  return random_map(seed, MapShape{});
}

// ---- What the loader may hand out in place of GL's own functions. GL's take no closure: state is global.
// -----

int live_names = 0;
GLint faked_name = 0, faked_value = 0;
bool refuse_textures = false, was_refused = false;

template <typename Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(EglContext::loader()(name));
}

void count_generated(GLsizei n, GLuint* names) {
  live_names += n;
  real<void (*)(GLsizei, GLuint*)>("glGenTextures")(n, names);
}
void count_deleted(GLsizei n, const GLuint* names) {
  live_names -= n;
  real<void (*)(GLsizei, const GLuint*)>("glDeleteTextures")(n, names);
}
void fake_integer(GLenum name, GLint* value) {
  if (static_cast<GLint>(name) == faked_name)
    *value = faked_value;
  else
    real<void (*)(GLenum, GLint*)>("glGetIntegerv")(name, value);
}
void refuse_image(GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void*) {
  was_refused = true;
}
GLenum out_of_memory() {
  const bool told = refuse_textures && was_refused;
  was_refused = false;
  return told ? GL_OUT_OF_MEMORY : GL_NO_ERROR;
}

GlSymbolLoader replace(const std::string& name, void* function) {
  return [=](const char* asked) { return name == asked ? function : EglContext::loader()(asked); };
}

std::string refusal(const GlSymbolLoader& load) {
  try {
    const ShadowTextures shadows(load);
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::resource);
    return error.what();
  }
  return {};
}

// ---------------------------------------------------------------------------------------------------------------

TEST(ShadowTextures, UploadingAgainLeaksNothing) {
  const EglContext context(GlApi::core_33);
  live_names = 0;
  const GlSymbolLoader counting = [](const char* name) -> void* {
    if (std::strcmp(name, "glGenTextures") == 0) return reinterpret_cast<void*>(&count_generated);
    if (std::strcmp(name, "glDeleteTextures") == 0) return reinterpret_cast<void*>(&count_deleted);
    return EglContext::loader()(name);
  };
  const PenumbraMap a = small_map(1), b = small_map(2);
  {
    ShadowTextures shadows(counting);
    for (int n = 0; n < 20; ++n) {
      const PenumbraMap* const maps[] = {n % 2 == 0 ? &a : &b};
      shadows.upload(maps, n % 3 == 0 ? TextureLayout::fixed_depth : TextureLayout::two_level);
      EXPECT_EQ(live_names, 2);
    }
  }
  EXPECT_EQ(live_names, 0);
}

TEST(ShadowTextures, AMapIsReplacedAndItsSettingsStay) {
  const EglContext context(GlApi::core_33);
  ShadowTextures shadows(EglContext::loader());
  const PenumbraMap a = small_map(1), b = small_map(2);
  const PenumbraMap* maps[] = {&a};
  shadows.upload(maps);
  shadows.set_look_up(0, {Filter::nearest, 0});
  maps[0] = &b;
  shadows.upload(maps);
  testing::Random random(1);
  const auto points = testing::points_to_try(random, b, 2000);
  const PenumbraLookUp look_up(b);
  const auto values = testing::gpu_look_up(shadows, GlApi::core_33, 0, points);
  for (std::size_t n = 0; n < points.size(); ++n) {
    ASSERT_TRUE(testing::may_say(values[n], b, look_up, points[n], Filter::nearest));
  }
}

TEST(ShadowTextures, RestoresWhatItDoesNotOwn) {
  const EglContext context(GlApi::core_33);
  ShadowTextures shadows(EglContext::loader());
  const testing::GlProgram mine(testing::target_vertex_shader("#version 330\n"),
                                "#version 330\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n");
  GLuint texture = 0, buffer = 0;
  glGenTextures(1, &texture);
  glGenBuffers(1, &buffer);
  glActiveTexture(GL_TEXTURE3);
  glBindTexture(GL_TEXTURE_2D, texture);
  glBindBuffer(GL_UNIFORM_BUFFER, buffer);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 77);
  glUseProgram(mine.name());

  const PenumbraMap map = small_map(1);
  const PenumbraMap* const maps[] = {&map};
  shadows.upload(maps);
  shadows.bind(mine.name());

  const auto get = [](GLenum name) {
    GLint value = -1;
    glGetIntegerv(name, &value);
    return static_cast<GLuint>(value);
  };
  EXPECT_EQ(get(GL_ACTIVE_TEXTURE), static_cast<GLuint>(GL_TEXTURE3));
  EXPECT_EQ(get(GL_TEXTURE_BINDING_2D), texture);
  EXPECT_EQ(get(GL_UNIFORM_BUFFER_BINDING), buffer);
  EXPECT_EQ(get(GL_PIXEL_UNPACK_BUFFER_BINDING), buffer);
  EXPECT_EQ(get(GL_UNPACK_ALIGNMENT), 8U);
  EXPECT_EQ(get(GL_UNPACK_ROW_LENGTH), 77U);
  EXPECT_EQ(get(GL_CURRENT_PROGRAM), mine.name());
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(ShadowTextures, SaysWhichFunctionIsMissing) {
  const EglContext context(GlApi::core_33);
  EXPECT_EQ(refusal(replace("glTexImage2D", nullptr)), "OpenGL: glTexImage2D is missing");
}

TEST(ShadowTextures, RefusesAnOldContext) {
  const EglContext context(GlApi::core_33);
  faked_name = GL_MAJOR_VERSION;
  faked_value = 2;
  const std::string told = refusal(replace("glGetIntegerv", reinterpret_cast<void*>(&fake_integer)));
  EXPECT_EQ(told.rfind("OpenGL: 3.3 or ES 3.0 is needed, this is ", 0), 0U) << told;
}

TEST(ShadowTextures, TellsTheLimitThatAMapExceedsAndKeepsWhatIsThere) {
  const EglContext context(GlApi::core_33);
  faked_name = GL_MAX_TEXTURE_SIZE;
  faked_value = 32;
  ShadowTextures shadows(replace("glGetIntegerv", reinterpret_cast<void*>(&fake_integer)));
  const PenumbraMap small = small_map(1);
  MapShape shape;
  shape.width = 70;
  const PenumbraMap large = random_map(2, shape);
  const PenumbraMap* maps[] = {&small};
  shadows.upload(maps);
  const std::uint64_t bytes = shadows.texture_bytes();
  maps[0] = &large;
  try {
    shadows.upload(maps);
    FAIL() << "a map of 70 texels was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::resource);
    EXPECT_EQ(std::string(error.what()).rfind("maps[0]: the set needs ", 0), 0U) << error.what();
  }
  EXPECT_EQ(shadows.texture_bytes(), bytes);
  EXPECT_EQ(shadows.map_count(), 1U);
}

TEST(ShadowTextures, TellsWhenGlIsOutOfMemory) {
  const EglContext context(GlApi::core_33);
  refuse_textures = false;
  const GlSymbolLoader load = [](const char* name) -> void* {
    if (std::strcmp(name, "glTexImage2D") == 0) return reinterpret_cast<void*>(&refuse_image);
    if (std::strcmp(name, "glGetError") == 0) return reinterpret_cast<void*>(&out_of_memory);
    return EglContext::loader()(name);
  };
  ShadowTextures shadows(load);
  refuse_textures = true;
  const PenumbraMap map = small_map(1);
  const PenumbraMap* const maps[] = {&map};
  try {
    shadows.upload(maps);
    FAIL() << "uploaded without memory";
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::resource);
    EXPECT_NE(std::string(error.what()).find("was refused"), std::string::npos) << error.what();
  }
  EXPECT_EQ(shadows.map_count(), 0U);
}

}  // namespace
}  // namespace pdsm
