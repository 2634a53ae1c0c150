// SPDX-License-Identifier: Apache-2.0
#include "deep_exr_parts.h"

#include <algorithm>
#include <array>

namespace pdsm {

PenumbraMap make_shell(const PenumbraMap& map) {
  PenumbraMap shell;
  shell.views = map.views;
  shell.layers = map.layers;
  shell.layer_rule = map.layer_rule;
  shell.channels = map.channels;
  shell.coding = map.coding;
  shell.samples = map.samples;
  shell.metadata = map.metadata;
  shell.block_keys = map.block_keys;
  for (const FunctionImage& image : map.images) {
    FunctionImage& empty = shell.images.emplace_back();
    empty = {image.layer, image.view, image.channel, image.level, image.width, image.height, {}};
    for (const FunctionBlock& block : image.blocks) {
      FunctionBlock& empty_block = empty.blocks.emplace_back();
      empty_block.first.assign(block.first.size(), 0);
      empty_block.domain_end.assign(block.domain_end.size(), 0);
    }
  }
  return shell;
}

bool has_domain_end(const FunctionImage& image) {
  return std::any_of(image.blocks.begin(), image.blocks.end(),
                     [](const FunctionBlock& block) { return !block.domain_end.empty(); });
}

std::string part_name(const PenumbraMap& map, const FunctionImage& image) {
  constexpr std::array kChannels{".red", ".green", ".blue"};
  return map.layers[image.layer] + ".view" + std::to_string(image.view) +
         (map.channels == 1 ? "" : kChannels[image.channel]) + ".level" + std::to_string(image.level);
}

std::string to_hex(std::span<const std::byte> bytes) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  text.reserve(bytes.size() * 2);
  for (std::byte byte : bytes) {
    text.push_back(kDigits[std::to_integer<unsigned>(byte) >> 4]);
    text.push_back(kDigits[std::to_integer<unsigned>(byte) & 15]);
  }
  return text;
}

std::optional<std::vector<std::byte>> from_hex(const std::string& text) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
  };
  if (text.size() % 2 != 0) return std::nullopt;
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 2);
  for (std::size_t n = 0; n < text.size(); n += 2) {
    const int high = digit(text[n]), low = digit(text[n + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    bytes.push_back(static_cast<std::byte>(high * 16 + low));
  }
  return bytes;
}

TexelInBlock find_texel(const FunctionImage& image, std::uint32_t x, std::uint32_t y) {
  const std::uint32_t bx = x / kBlockSize, by = y / kBlockSize;
  const std::uint32_t block_width = std::min(kBlockSize, image.width - bx * kBlockSize);
  return {std::size_t{by} * image.blocks_across() + bx, y % kBlockSize * block_width + x % kBlockSize};
}

}  // namespace pdsm
