#include "harness/panel/frames.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/time.h"
#include "harness/record/temporary_folder.h"
#include "tests/harness/fixtures/temporary_fixtures.h"

namespace towbench::harness {
namespace {

using nlohmann::json;

std::vector<double> times_s(const json& rows) {
  std::vector<double> times;
  for (const auto& row : rows) {
    times.push_back(row.at(0).get<double>());
  }
  return times;
}

class Frames : public ::testing::Test {
 protected:
  ~Frames() override { session_->cut_short(); }

  void wait_until_over() const {
    while (session_->state().phase != Session::Phase::kOver) {
      std::this_thread::yield();
    }
  }

  TemporaryFolder out_;
  std::unique_ptr<Session> session_ = std::make_unique<Session>(out_.path());
  FrameMaker frames_{*session_};
};

TEST_F(Frames, AtFullSpeedOneQuestionInTwentyIsAnsweredAndTheEndAtOnce) {
  session_->start({.experiment = "circle", .pace = {.speed = 0, .paused = false}});
  std::vector<double> told_s;
  int answers = 0;
  constexpr int kTwenty = 20;  // questions a second, one answer
  int since_answer = kTwenty;
  for (bool over = false; !over;) {
    over = session_->state().phase == Session::Phase::kOver;
    const auto frame = frames_.next();
    ++since_answer;
    if (frame.empty()) {
      std::this_thread::yield();
      continue;
    }
    const auto said = json::parse(frame);
    if (said.at("state").at("phase") == "running") {
      EXPECT_GE(since_answer, kTwenty);
      since_answer = 0;
      ++answers;
    }
    const auto times = times_s(said.at("rows"));
    told_s.insert(told_s.end(), times.begin(), times.end());
  }
  EXPECT_GT(answers, 0);
  EXPECT_TRUE(std::is_sorted(told_s.begin(), told_s.end()));
  ASSERT_FALSE(told_s.empty());
  EXPECT_GT(told_s.back(), 15.0) << "the circle's last second";
}

// However little was told before: nobody read most of its rows.
TEST_F(Frames, AfterARunAtFullSpeedItsLastStretchIsTold) {
  session_->start({.experiment = "wall-clock-60s", .pace = {.speed = 0, .paused = false}});
  EXPECT_FALSE(frames_.next().empty());
  wait_until_over();
  const auto said = json::parse(frames_.next());
  EXPECT_EQ(said.at("state").at("dropped"), 0) << "nobody could have followed them";
  for (const char* const kind : {"rows", "truth"}) {
    const auto times = times_s(said.at(kind));
    ASSERT_GT(times.size(), 100U) << kind;
    EXPECT_GT(times.back(), 55.0) << kind;
    EXPECT_NEAR(times.back() - times.front(), 20.0, 0.2) << kind;
    for (std::size_t i = 1; i < times.size(); ++i) {
      EXPECT_LT(times[i] - times[i - 1], 0.2) << kind << " at " << times[i];
    }
  }
}

TEST_F(Frames, RowsThatAreGoneBeforeTheyWereReadAreCounted) {
  bbmc::TelemetryRow row;
  for (int i = 0; i < 100'000; ++i) {
    row.time_ns = i * core::kNanosecondsPerMillisecond;
    session_->tap().row(row, {});
  }
  std::vector<LiveRow> kept;
  const auto gone = session_->tap().rows().copy(0, kept);
  EXPECT_GT(gone, 0U);
  for (int question = 0; question < 2; ++question) {
    const auto said = json::parse(frames_.next());
    EXPECT_EQ(said.at("state").at("dropped"), gone);
    session_->tap().row(row, {});
  }
}

// The last two of a row.
TEST_F(Frames, TheForceIsToldOfARigThatHasItsSensor) {
  const TemporaryFixtures fixtures;
  for (const auto* const rig : {"tow-dry", "macs-nominal"}) {
    const auto shipped = std::filesystem::relative("fixtures", fixtures.folder()).string();
    const auto file = fixtures.write(
        std::string(rig) + ".toml",
        fmt::format("schema = 1\nname = \"{0}\"\nrig = \"{1}/rigs/{0}.toml\"\n"
                    "controller = \"{1}/controllers/bbmc-tuned.toml\"\n"
                    "duration_limit_s = 2.0\n\n"
                    "[[console]]\nsend = \"reset poscalib y 0.449092m\"\nexpect = \"ok\"\n\n"
                    "[[console]]\nsend = \"run -trapez y --distance 0.1m --speed 0.2m/s "
                    "--acceleration 0.2s\"\nexpect = \"done\"\nwait = \"idle\"\ntimeout_s = 1.5\n",
                    rig, shipped));
    session_->start({.experiment = file.string(), .pace = {.speed = 0, .paused = false}});
    wait_until_over();
    const auto rows = json::parse(frames_.next()).at("rows");
    ASSERT_GT(rows.size(), 50U) << rig << ": " << session_->state().reason;
    const auto& last = rows.back();
    EXPECT_EQ(last.at(last.size() - 1).is_number(), std::string(rig) == "tow-dry") << rig;
    EXPECT_EQ(last.at(last.size() - 2).is_number(), std::string(rig) == "tow-dry") << rig;
  }
}

TEST_F(Frames, BelowFullSpeedWhatIsNewIsToldWithTheNextQuestion) {
  session_->start({.experiment = "circle", .pace = {.speed = 0.001, .paused = true}});
  EXPECT_FALSE(frames_.next().empty());
  for (const double speed : {0.002, 0.003, 0.004}) {
    session_->run_operator().set_speed(speed);
    EXPECT_FALSE(frames_.next().empty()) << speed;
  }
}

TEST_F(Frames, WhatThePageNoLongerShowsIsNotTold) {
  bbmc::TelemetryRow row;
  emulator::TruthRow truth;
  constexpr int kRows = 10'000;
  constexpr core::Nanoseconds kPeriod_ns = 4 * core::kNanosecondsPerMillisecond;  // 40 s in all
  for (int i = 0; i < kRows; ++i) {
    row.time_ns = truth.time_ns = i * kPeriod_ns;
    session_->tap().row(row, {});
    session_->tap().truth(truth);
  }
  const auto said = json::parse(frames_.next());
  for (const char* const kind : {"rows", "truth"}) {
    const auto times = times_s(said.at(kind));
    ASSERT_GT(times.size(), 100U) << kind;
    EXPECT_LE(times.size(), FrameMaker::kMostRows) << kind;
    EXPECT_NEAR(times.front(), 20.0, 0.5) << kind;
    EXPECT_DOUBLE_EQ(times.back(), core::seconds((kRows - 1) * kPeriod_ns)) << kind;
  }
}

}  // namespace
}  // namespace towbench::harness
