// Firmware written for the purpose (firmware/exercise.c) executes on the board while this test
// plays the machine: interrupts that nest, widths of access, VFP, Thumb, SVC, capture from creep to
// full speed, a bouncing switch.
#include <string>

#include <gtest/gtest.h>

#include "board/board.h"

namespace towbench::board {
namespace {

#ifdef TOWBENCH_FIRMWARE_FOLDER

class Exercise {
 public:
  Exercise() {
    auto image = ElfImage::read(TOWBENCH_FIRMWARE_FOLDER "/exercise.elf");
    EXPECT_TRUE(image);
    EXPECT_EQ(board_.load(std::move(*image)), "");
  }

  // Until the console has printed that; false after ten seconds of the board's time.
  bool run_until_said(const std::string& words) {
    const core::Nanoseconds limit_ns = board_.now_ns() + 10 * core::kNanosecondsPerSecond;
    while (text_.find(words) == std::string::npos) {
      if (board_.now_ns() >= limit_ns || board_.verdict()) {
        return false;
      }
      board_.run_until(board_.now_ns() + core::kPlantTick_ns);
      text_ += board_.uart().take_sent();
    }
    return true;
  }
  void run_for(core::Nanoseconds span_ns) {
    const core::Nanoseconds end_ns = board_.now_ns() + span_ns;
    while (board_.now_ns() < end_ns) {
      board_.run_until(board_.now_ns() + core::kPlantTick_ns);
      text_ += board_.uart().take_sent();
    }
  }
  std::string take_text() { return std::exchange(text_, {}); }
  Board& board() { return board_; }

 private:
  Board board_;
  std::string text_;
};

TEST(Firmware, EveryCheckOfTheExerciseHolds) {
  Exercise exercise;
  ASSERT_TRUE(exercise.run_until_said("no load while frozen")) << exercise.take_text();
  exercise.run_for(5 * core::kNanosecondsPerMillisecond);
  const std::string text = exercise.take_text();
  EXPECT_EQ(text.find(" not "), std::string::npos) << text;
  for (const char* name :
       {"halfword", "byte", "word", "pinmux", "clock", "nested twice", "fast inside slow",
        "shadow full before zero", "shadow loaded at zero", "time base frozen",
        "no load while frozen", "vsqrt low", "thumb", "supervisor call"}) {
    EXPECT_NE(text.find(std::string(name) + " ok"), std::string::npos) << name << "\n" << text;
  }
  EXPECT_GE(exercise.board().profile().interrupt(68).count, 10U);
  EXPECT_LE(exercise.board().profile().interrupt(69).worst, 200U);

  // 2.2456 um a count: from 0.1 mm/s to 0.6 m/s.
  unsigned phase = 0;
  for (const double speed_m_per_s : {1e-4, 1e-3, 1e-2, 0.1, 0.6}) {
    const auto gap_ns = static_cast<core::Nanoseconds>(2.2456e-6 / speed_m_per_s * 1e9);
    exercise.board().uart().type("c");
    const core::Nanoseconds start_ns = exercise.board().now_ns() + 5'000'000;
    const core::Nanoseconds end_ns = start_ns + 50'000'000;
    for (core::Nanoseconds t = start_ns; t < end_ns; t += gap_ns) {
      exercise.board().encoder(1).push_edge(phase++ % 2 == 0 ? EncoderLine::kA : EncoderLine::kB,
                                            t);
    }
    exercise.run_for(70 * core::kNanosecondsPerMillisecond);
    const std::string answer = exercise.take_text();
    const auto at = answer.find("capture 0x");
    ASSERT_NE(at, std::string::npos) << answer;
    const auto period = static_cast<double>(std::stoul(answer.substr(at + 8), nullptr, 16));
    EXPECT_NEAR(period, static_cast<double>(gap_ns) / 640.0, 1.0) << speed_m_per_s;
  }

  exercise.board().uart().type("x");
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(exercise.run_until_said("flow\r\n"));
    exercise.take_text();
    exercise.board().uart().type(std::string(101, 'z'));
  }
  ASSERT_TRUE(exercise.run_until_said("bounce\r\n"));
  const std::string flow = exercise.take_text();
  EXPECT_EQ(flow.find(" not "), std::string::npos) << flow;
  EXPECT_NE(flow.find("every byte came ok"), std::string::npos) << flow;
  core::Nanoseconds t = exercise.board().now_ns();
  for (const int bounce_us : {100, 150, 90, 200, 100, 50, 120}) {  // none lasts 310 us
    t += bounce_us * core::kNanosecondsPerMicrosecond;
    exercise.board().gpio(1).drive(14, true, t);
    exercise.board().gpio(1).drive(14, false, t + 40'000);
  }
  exercise.board().gpio(1).drive(14, true, t + 90'000);
  exercise.run_for(2 * core::kNanosecondsPerMillisecond);
  exercise.board().uart().type("x");
  ASSERT_TRUE(exercise.run_until_said("end\r\n")) << exercise.take_text();
  EXPECT_NE(exercise.take_text().find("one edge of a bouncing switch ok"), std::string::npos);
}

TEST(Firmware, TwoRunsAreTheSameToTheInstruction) {
  const auto run = [] {
    Exercise exercise;
    exercise.run_for(100 * core::kNanosecondsPerMillisecond);
    return std::pair(exercise.board().profile().instructions(), exercise.take_text());
  };
  EXPECT_EQ(run(), run());
}

#else

TEST(Firmware, NeedsACrossCompiler) {
  GTEST_SKIP() << "no arm-none-eabi-gcc where this was built";
}

#endif

}  // namespace
}  // namespace towbench::board
