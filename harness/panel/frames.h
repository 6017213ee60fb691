// A run under way as the panel's page is told of it: frames of rows, events and states, as JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/panel/live_estimators.h"
#include "harness/panel/session.h"
#include "harness/panel/truth_tail.h"

namespace towbench::harness {

// Asked twenty times a second, it takes all that has come and tells it at once. A run at full
// speed, which nobody can follow, is told of once a second, and of the stretch that the page shows
// alone: whoever observes takes the processors that such a run would use. Nobody reads the rows in
// between. The rows of a frame are thinned to `kMostRows`, by buckets of time: each bucket's last
// row and the one with the largest tracking error.
class FrameMaker {
 public:
  static constexpr std::size_t kMostRows = 240;
  static constexpr int kHeldBack = 20;  // questions between two frames at full speed
  static constexpr core::Nanoseconds kShown_ns = 20'000'000'000;  // reports/src/panel/run_view.ts

  explicit FrameMaker(Session& session) : session_(session) {}

  // Empty when nothing has changed or it is not told yet.
  [[nodiscard]] std::string next();
  // The state of things for somebody who has just come.
  [[nodiscard]] std::string greeting();

 private:
  struct SeenRow {
    LiveRow live;
    core::PerAxis<double> position_m;
    LiveEstimators::Speeds speeds;
  };
  // What has come and is not told.
  struct Untold {
    std::string events{};
    std::string console{};
    std::string trouble{};  // why the last command came to nothing

    [[nodiscard]] bool is_empty() const noexcept {
      return events.empty() && console.empty() && trouble.empty();
    }
    void clear() noexcept {
      events.clear();
      console.clear();
      trouble.clear();
    }
  };

  [[nodiscard]] static double worst_error_m(const SeenRow& row);
  [[nodiscard]] static double worst_error_m(const LiveTruth& row);
  // Of each bucket the row with the largest figure and the last one, in order of time.
  template <typename Row>
  [[nodiscard]] static std::vector<Row> thinned(const std::vector<Row>& rows);

  void begin(std::uint64_t number);
  void take_words();
  template <typename Row>
  void catch_up(const LastRows<Row>& rows, std::uint64_t& next, std::vector<Row>& fresh);
  [[nodiscard]] std::vector<SeenRow> take_rows();
  [[nodiscard]] std::vector<LiveTruth> take_truths();
  [[nodiscard]] bool holds_back();
  static void add_axis(std::string& text, const SeenRow& row, core::Axis which);
  [[nodiscard]] std::string text_of(const std::vector<SeenRow>& rows) const;
  [[nodiscard]] std::string text_of(const std::vector<LiveTruth>& rows) const;
  [[nodiscard]] bool shows_further_axes() const noexcept {
    return shown_.size() > core::kPlanarAxes.size();
  }
  [[nodiscard]] std::string state_text();

  Session& session_;
  std::uint64_t number_ = 0;  // of the run that these belong to
  std::optional<LiveEstimators> estimators_;
  core::PerAxis<double> m_per_count_;
  RecordedAxes shown_ = planar_axes();
  std::optional<TruthTail> tail_;  // of a plant in another process, once its folder is there
  Untold untold_;
  std::uint64_t next_row_ = 0;  // to be read, of the tap's
  std::uint64_t next_truth_ = 0;
  std::uint64_t missed_ = 0;                         // rows that were gone before they were read
  bool in_stretches_ = false;                        // what lies between two frames is not wanted
  std::optional<std::uint64_t> told_at_full_speed_;  // the run of the last frame, if it was
  int held_back_ = 0;                                // questions since then
  std::string last_state_;
  // At full speed thousands a question. Kept: memory that came and went would interrupt the bench's
  // processor each time to forget where it was.
  std::vector<LiveRow> fresh_rows_;
  std::vector<LiveTruth> fresh_truths_;
  std::vector<SeenRow> seen_;
};

}  // namespace towbench::harness
