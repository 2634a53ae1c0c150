// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/tube_check.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <mutex>

#include "tile/bake_blocks.h"
#include "tile/bake_job.h"

namespace pdsm {
namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();

/// The least, or by std::greater the greatest, value of a window of segments that only moves on.
template <typename Better>
class WindowExtreme {
 public:
  void enter(std::size_t segment, double value) {
    while (!queue_.empty() && !Better()(queue_.back().value, value)) queue_.pop_back();
    queue_.push_back({segment, value});
  }
  void leave_before(std::size_t segment) {
    while (queue_.front().segment < segment) queue_.pop_front();
  }
  [[nodiscard]] double get() const { return queue_.front().value; }

 private:
  struct Entry {
    std::size_t segment;
    double value;
  };
  std::deque<Entry> queue_;
};

/// The walls of a tube for depths that only grow. Segment n of the step function lies over
/// (depth[n - 1], depth[n]]; a window of half width delta around z meets it if
///   depth[n - 1] - delta < z <= depth[n] + delta
class Walls {
 public:
  Walls(const DepthSteps& truth, double delta) : truth_(truth), delta_(delta) {
    least_.enter(0, 0);
    greatest_.enter(0, 0);
  }

  /// Moves on to depths (begin, end], among which no wall moves.
  void move_to(double begin, double end) {
    while (entered_ < truth_.depth.size() && truth_.depth[entered_] - delta_ <= begin) {
      least_.enter(entered_ + 1, truth_.value[entered_]);
      greatest_.enter(entered_ + 1, truth_.value[entered_]);
      ++entered_;
    }
    while (left_ < truth_.depth.size() && truth_.depth[left_] + delta_ < end) ++left_;
    least_.leave_before(left_);
    greatest_.leave_before(left_);
  }
  [[nodiscard]] double margin(double value, double epsilon) const {
    return std::min(value - (least_.get() - epsilon), greatest_.get() + epsilon - value);
  }

 private:
  const DepthSteps& truth_;
  double delta_;
  WindowExtreme<std::less<>> least_;
  WindowExtreme<std::greater<>> greatest_;
  std::size_t entered_ = 0, left_ = 0;  ///< steps
};

/// Value of piece `n` at depth z in it.
double piece_value(const DepthPieces& pieces, std::size_t n, double z) {
  if (n + 1 == pieces.depth.size()) return pieces.begin[n];
  const double share = (z - pieces.depth[n]) / (pieces.depth[n + 1] - pieces.depth[n]);
  return pieces.begin[n] + share * (pieces.end[n] - pieces.begin[n]);
}

/// Depths from near on at which a wall moves or a piece ends, in order, then for ever.
std::vector<double> breakpoints(const DepthSteps& truth, const DepthPieces& fitted, double near_depth,
                                double delta) {
  std::vector<double> at(fitted.depth);
  for (const double depth : truth.depth) at.insert(at.end(), {depth - delta, depth + delta});
  std::erase_if(at, [near_depth](double z) { return z < near_depth; });
  at.insert(at.end(), {near_depth, kForEver});
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

DepthSteps decode_steps(const View& view, const VertexCoding& coding,
                        const std::vector<FunctionVertex>& vertices) {
  DepthSteps steps;
  for (const FunctionVertex& vertex : vertices) {
    steps.depth.push_back(decode_depth(view, coding, vertex.depth));
    steps.value.push_back(static_cast<double>(vertex.begin) / coding.value_max);
  }
  return steps;
}

DepthPieces decode_pieces(const View& view, const VertexCoding& coding,
                          const std::vector<FunctionVertex>& vertices) {
  DepthPieces pieces;
  for (const FunctionVertex& vertex : vertices) {
    pieces.depth.push_back(decode_depth(view, coding, vertex.depth));
    pieces.begin.push_back(static_cast<double>(vertex.begin) / coding.value_max);
    pieces.end.push_back(static_cast<double>(vertex.end) / coding.value_max);
  }
  return pieces;
}

/// How far depths may be off on the way through codes: the oracle's own half step, and rounding in double.
double oracle_reach(const View& view, const VertexCoding& oracle) {
  return depth_step(view, oracle) / 2 + 0x1.0p-48 * view.far_depth;
}

TubeCheck check_block(const BakeJob& oracle, const FunctionBlock& exact, const FittedBlock& place,
                      const BakedMap& fitted) {
  const View& view = oracle.fitted.view;
  const VertexCoding &exact_coding = oracle.rules.coding, &coding = fitted.map.coding;
  const FunctionBlock block =
      decode_block(coding, place.width, place.height, fitted.blocks.front()[place.index]);
  const double delta = fitted.report.depth_tolerance + oracle_reach(view, exact_coding);
  TubeCheck check;
  for (std::uint32_t texel = 0; texel < place.width * place.height; ++texel) {
    const DepthSteps steps = decode_steps(view, exact_coding, unpack_function(exact_coding, exact, texel));
    const DepthPieces pieces = decode_pieces(view, coding, unpack_function(coding, block, texel));
    check.add(tube_margin(steps, pieces, view.near_depth, fitted.report.epsilon, delta));
  }
  return check;
}

}  // namespace

double tube_margin(const DepthSteps& truth, const DepthPieces& fitted, double near_depth, double epsilon,
                   double delta) {
  // 0 within 0 +- epsilon: most functions of a map.
  if (truth.depth.empty() && fitted.depth.empty()) return epsilon;
  const std::vector<double> at = breakpoints(truth, fitted, near_depth, delta);
  Walls walls(truth, delta);
  double worst = kForEver;
  std::size_t begun = 0;  // pieces
  for (std::size_t n = 0; n + 1 < at.size(); ++n) {
    walls.move_to(at[n], at[n + 1]);
    while (begun < fitted.depth.size() && fitted.depth[begun] <= at[n]) ++begun;
    if (begun == 0) {
      worst = std::min(worst, walls.margin(0, epsilon));
      continue;
    }
    for (const double z : {at[n], at[n + 1]})
      worst = std::min(worst, walls.margin(piece_value(fitted, begun - 1, z), epsilon));
  }
  return worst;
}

void TubeCheck::add(double margin) {
  ++functions;
  outside += margin < -kTubeSlack ? 1 : 0;
  worst_margin = std::min(worst_margin, margin);
}

void TubeCheck::add(const TubeCheck& other) {
  functions += other.functions;
  outside += other.outside;
  worst_margin = std::min(worst_margin, other.worst_margin);
}

std::vector<TubeCheck> check_tubes(const Scene& scene, const Light& light, BakeOptions options,
                                   std::span<const BakedMap> fitted, const BakeCallbacks& callbacks) {
  options.epsilon = 0;
  options.depth_tolerance = 0;
  const BakeJob oracle(scene, light, options);
  std::vector<TubeCheck> checks(fitted.size());
  std::mutex mutex;
  const auto check = [&](FittedBlock&& block) {
    for (std::size_t n = 0; n < fitted.size(); ++n) {
      const TubeCheck of_block = check_block(oracle, block.levels.front(), block, fitted[n]);
      const std::lock_guard lock(mutex);
      checks[n].add(of_block);
    }
  };
  bake_blocks(oracle, check, callbacks);
  return checks;
}

}  // namespace pdsm
