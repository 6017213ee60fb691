// What the panel's page is told, as JSON: frames of a run under way, what there is to choose from,
// what runs there are.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/panel/live_estimators.h"
#include "harness/panel/session.h"
#include "harness/panel/truth_tail.h"

namespace towbench::harness {

// Everything that has come since the last call. The rows of a frame are thinned to `kMostRows`, by
// buckets of time: each bucket's last row and the one with the largest tracking error.
class FrameMaker {
 public:
  static constexpr std::size_t kMostRows = 240;

  explicit FrameMaker(Session& session) : session_(session) {}

  // Empty when nothing has changed.
  [[nodiscard]] std::string next();
  // The state of things for somebody who has just come.
  [[nodiscard]] std::string greeting();

 private:
  struct SeenRow {
    LiveRow live;
    core::PerAxis<double> position_m;
    LiveEstimators::Speeds speeds;
  };

  [[nodiscard]] static double worst_error_m(const SeenRow& row);
  [[nodiscard]] static double worst_error_m(const LiveTruth& row);
  // Of each bucket the row with the largest figure and the last one, in order of time.
  template <typename Row>
  [[nodiscard]] static std::vector<Row> thinned(const std::vector<Row>& rows);

  [[nodiscard]] std::string state_text();
  [[nodiscard]] std::string rows_text();
  [[nodiscard]] std::string truths_text();
  void take_truths();
  void begin(std::uint64_t number);

  Session& session_;
  std::uint64_t number_ = 0;  // of the run that these belong to
  std::optional<LiveEstimators> estimators_;
  core::PerAxis<double> m_per_count_;
  std::optional<TruthTail> tail_;  // of a plant in another process, once its folder is there
  std::string last_state_;
  // At full speed thousands a frame. Kept from frame to frame: memory that came and went would
  // interrupt the bench's processor each time to forget where it was.
  std::vector<SeenRow> seen_;
  std::vector<LiveTruth> truths_;
};

// Experiments with their console lines, fault kinds with their parameters, BBMC's commands with
// their ranges.
[[nodiscard]] std::string catalogue_json();

// Run folders and campaigns below `runs`, the youngest first.
[[nodiscard]] std::string folders_json(const std::filesystem::path& runs);

}  // namespace towbench::harness
