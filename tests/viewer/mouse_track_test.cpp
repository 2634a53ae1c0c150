// SPDX-License-Identifier: Apache-2.0
#include "mouse_track.h"

#include <gtest/gtest.h>

namespace pdsm {
namespace {

TEST(MouseTrack, AClickWithinOneFrameIsAClick) {
  MouseTrack mouse;
  mouse.move({100, 50});
  mouse.press(MouseButton::left);
  mouse.move({102, 51});
  mouse.release(MouseButton::left);
  mouse.move({300, 300});
  const MouseEvents events = mouse.take();
  ASSERT_TRUE(events.clicked);
  EXPECT_EQ(*events.clicked, glm::dvec2(100, 50));
  EXPECT_FALSE(mouse.take().clicked);
}

TEST(MouseTrack, AClickMayTakeManyFrames) {
  MouseTrack mouse;
  mouse.press(MouseButton::left);
  EXPECT_FALSE(mouse.take().clicked);
  mouse.release(MouseButton::left);
  EXPECT_TRUE(mouse.take().clicked);
}

TEST(MouseTrack, ADragIsNoClick) {
  MouseTrack mouse;
  mouse.press(MouseButton::left);
  mouse.move({5, 0});
  mouse.release(MouseButton::left);
  EXPECT_FALSE(mouse.take().clicked);
}

TEST(MouseTrack, OnlyTheLeftButtonClicks) {
  MouseTrack mouse;
  mouse.press(MouseButton::right);
  mouse.release(MouseButton::right);
  mouse.release(MouseButton::left);  // went down before the window had the mouse
  EXPECT_FALSE(mouse.take().clicked);
}

TEST(MouseTrack, DragsCountFromPressToReleaseOnly) {
  MouseTrack mouse;
  mouse.move({10, 10});
  mouse.press(MouseButton::middle);
  mouse.move({30, 5});
  mouse.release(MouseButton::middle);
  mouse.move({500, 500});
  const MouseEvents events = mouse.take();
  EXPECT_EQ(events.drag(MouseButton::middle), glm::dvec2(20, -5));
  EXPECT_EQ(events.drag(MouseButton::left), glm::dvec2(0));
  EXPECT_EQ(events.drag(MouseButton::right), glm::dvec2(0));
}

TEST(MouseTrack, ADragGoesOnInTheNextFrame) {
  MouseTrack mouse;
  mouse.press(MouseButton::left);
  mouse.move({10, 0});
  EXPECT_EQ(mouse.take().drag(MouseButton::left), glm::dvec2(10, 0));
  mouse.move({10, 7});
  EXPECT_EQ(mouse.take().drag(MouseButton::left), glm::dvec2(0, 7));
}

TEST(MouseTrack, ScrollingAddsUp) {
  MouseTrack mouse;
  mouse.scroll(1);
  mouse.scroll(1.5);
  EXPECT_EQ(mouse.take().scrolled, 2.5);
  EXPECT_EQ(mouse.take().scrolled, 0);
}

}  // namespace
}  // namespace pdsm
