// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "evaluate/image_io.h"
#include "gl_objects.h"
#include "shader_program.h"

namespace pdsm {

/// Where a frame is drawn: surfaces that do not move, a still that is shaded from them, a picture that begins
/// as the still and gets what moves, an output in which several pictures may be averaged and panels are
/// drawn. The window only gets a copy, so that a hidden one does as well.
class FrameTargets {
 public:
  FrameTargets() : array_(GlVertexArray::make()) {}

  /// Makes room for a size in pixels; nothing when it is there already. Throws Error (resource).
  void resize(int width, int height);

  /// Draws go to the surfaces (surface.frag's outputs) from here on; clears them.
  void begin_surfaces() const;
  /// Draws go to the still from here on, without depth; binds the surfaces' textures.
  void begin_still() const;
  /// Draws go to the picture from here on, a copy of the still with the surfaces' depth.
  void begin_picture() const;
  /// Draws go to the picture without depth from here on; binds its depth as a texture.
  void begin_air() const;
  /// The target of begin_air() again.
  void bind_air() const;
  /// One triangle over all pixels of the target, with the program in use.
  void fill() const;

  /// Makes the picture the output; `smooth`, when not null, takes the steps off its edges.
  void output_picture(const ShaderProgram* smooth) const;
  /// Adds the picture as number `index` (0 begins anew) to those whose mean output_mean() shows.
  void add_to_mean(const ShaderProgram& copy, int index) const;
  void output_mean(const ShaderProgram& copy) const;
  void bind_output() const;

  /// Copies the output to the window.
  void show() const;
  /// The output as it is now. Display values, row 0 on top.
  [[nodiscard]] RgbImage read() const;

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] GLuint position_texture() const { return position_.name(); }

 private:
  void copy_all(GLbitfield what) const;

  int width_ = 0, height_ = 0;
  GlTexture position_, normal_, colour_, still_, picture_, depth_, output_, mean_;
  GlRenderbuffer still_depth_;
  GlFramebuffer to_surfaces_, to_still_, to_picture_, to_air_, to_output_, to_mean_;
  GlVertexArray array_;  // empty: full_screen.vert makes its own vertices
};

}  // namespace pdsm
