// SPDX-License-Identifier: Apache-2.0
// A fuzz target without a fuzzer, for ctest: feeds each file of a corpus, every truncated prefix of it, and
// random changes of it that are the same each time.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "fuzz_target.h"

namespace {

namespace fs = std::filesystem;
using Input = std::vector<std::uint8_t>;

// Changed copies of each corpus file; with more a run takes longer than a few seconds.
constexpr int kChangedCopies = 300;

// Of larger files not every prefix is fed, but about so many.
constexpr std::size_t kMostPrefixes = 2000;

/// What is being fed, for whoever finds the process dead.
std::string g_now;

void feed(const Input& input, const std::string& what) {
  g_now = what;
  // An allocation of exactly this size, so that a sanitizer sees each byte read behind the end.
  const std::unique_ptr<std::uint8_t[]> exact(new std::uint8_t[input.size()]);
  std::copy(input.begin(), input.end(), exact.get());
  LLVMFuzzerTestOneInput(exact.get(), input.size());
}

/// mt19937 is specified bit for bit; the standard's distributions are not, so they are not used.
std::size_t below(std::mt19937& random, std::size_t bound) {
  return random() % bound;
}

/// One change: a byte, a bit, a run taken out, a run put in twice.
void change(Input& input, std::mt19937& random) {
  if (input.empty()) return;
  const std::size_t at = below(random, input.size());
  const auto place = input.begin() + static_cast<std::ptrdiff_t>(at);
  const auto run =
      static_cast<std::ptrdiff_t>(1 + below(random, std::min<std::size_t>(16, input.size() - at)));
  switch (random() % 4) {
    case 0:
      *place = static_cast<std::uint8_t>(random());
      break;
    case 1:
      *place ^= static_cast<std::uint8_t>(1U << random() % 8);
      break;
    case 2:
      input.erase(place, place + run);
      break;
    default: {
      const Input copy(place, place + run);
      input.insert(place, copy.begin(), copy.end());
    }
  }
}

void feed_variants(const Input& input, const std::string& name) {
  feed(input, name);
  const std::size_t step = input.size() / kMostPrefixes + 1;
  for (std::size_t size = 0; size < input.size(); size += step) {
    feed(Input(input.begin(), input.begin() + static_cast<std::ptrdiff_t>(size)),
         name + " cut to " + std::to_string(size) + " bytes");
  }
  for (int copy = 0; copy < kChangedCopies; ++copy) {
    std::mt19937 random(static_cast<unsigned>(copy));
    Input changed = input;
    for (std::size_t changes = 1 + below(random, 4); changes > 0; --changes) change(changed, random);
    feed(changed, name + " changed with seed " + std::to_string(copy));
  }
}

Input content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The files of a folder in the order of their names, which a folder does not keep.
std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

void tell_input() {
  std::fprintf(stderr, "while reading %s\n", g_now.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s CORPUS_FOLDER\n", argv[0]);
    return 2;
  }
  std::signal(SIGABRT, [](int) { tell_input(); });
  const auto paths = files_of(argv[1]);
  for (const fs::path& path : paths) feed_variants(content(path), path.filename().string());
  std::printf("%zu files and their variants\n", paths.size());
  return paths.empty() ? 1 : 0;
}
