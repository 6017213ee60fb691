// The board as a whole on images of a few instructions, assembled by hand (the comments are the
// assembler's).
#include "board/board.h"

#include <gtest/gtest.h>

#include "tests/board/small_image.h"

namespace towbench::board {
namespace {

constexpr core::Nanoseconds kTick_ns = core::kPlantTick_ns;

void load(Board& board, const std::vector<std::uint32_t>& code) {
  auto image = ElfImage::parse(small_image(code));
  ASSERT_TRUE(image);
  ASSERT_EQ(board.load(std::move(*image)), "");
}

void run_to(Board& board, core::Nanoseconds until_ns) {
  for (core::Nanoseconds t = board.now_ns() + kTick_ns; t <= until_ns; t += kTick_ns) {
    board.run_until(t);
  }
}

TEST(Board, AnAccessOutsideEveryBlockStopsWithAddressProgramCounterAndSymbol) {
  Board board;
  load(board, {
                  0xE3A00001,  // mov r0, #1
                  0xE59F1004,  // ldr r1, [pc, #4]
                  0xE5912004,  // ldr r2, [r1, #4]
                  0xEAFFFFFE,  // b .
                  0x50000000,
              });
  board.run_until(kTick_ns);
  ASSERT_TRUE(board.verdict());
  EXPECT_EQ(board.verdict()->failure, BoardFailure::kUnmappedAccess);
  EXPECT_EQ(board.verdict()->pc, kSmallImageAddress + 8);
  EXPECT_EQ(board.verdict()->sentence,
            "the image stopped at 0x80000008 (start+0x8): it reads 0x50000004, where the board has "
            "nothing");
}

TEST(Board, AnUndefinedInstructionAndABreakpointStop) {
  Board board;
  load(board, {0xE3A00001, 0xFFFFFFFF});
  board.run_until(kTick_ns);
  ASSERT_TRUE(board.verdict());
  EXPECT_EQ(board.verdict()->failure, BoardFailure::kUndefinedInstruction);
  EXPECT_EQ(board.verdict()->pc, kSmallImageAddress + 4);
}

TEST(Board, AJumpIntoNowhereStops) {
  Board board;
  load(board, {
                  0xE3A0F000,  // mov pc, #0
              });
  board.run_until(kTick_ns);
  ASSERT_TRUE(board.verdict());
  EXPECT_EQ(board.verdict()->failure, BoardFailure::kUnmappedAccess);
}

TEST(Board, SpinningWithInterruptsMaskedEndsAfterOneSecond) {
  Board board;
  load(board, {0xEAFFFFFE});  // b .
  run_to(board, 900 * core::kNanosecondsPerMillisecond);
  EXPECT_FALSE(board.verdict());
  run_to(board, 1'010 * core::kNanosecondsPerMillisecond);
  ASSERT_TRUE(board.verdict());
  EXPECT_EQ(board.verdict()->failure, BoardFailure::kSpinsMasked);
  EXPECT_LT(board.profile().instructions(), 100'000U) << "an idle loop is skipped, not executed";
}

TEST(Board, WaitingWithNothingEnabledEndsAfterOneSecond) {
  Board board;
  load(board, {
                  0xF1080080,  // cpsie i
                  0xE320F003,  // wfi
                  0xEAFFFFFD,  // b wfi
              });
  run_to(board, 1'010 * core::kNanosecondsPerMillisecond);
  ASSERT_TRUE(board.verdict());
  EXPECT_EQ(board.verdict()->failure, BoardFailure::kWaitsForNothing);
}

TEST(Board, ALoopThatChangesMemoryOnlyIsNotTakenForIdle) {
  Board board;
  load(board, {
                  0xE59F000C,  // ldr r0, [pc, #12]
                  0xE5901000,  // ldr r1, [r0]
                  0xE2811001,  // add r1, r1, #1
                  0xE5801000,  // str r1, [r0]
                  0xE3A01000,  // mov r1, #0
                  0xEAFFFFFA,  // b ldr r1
                  0x80000018,
              });
  // The literal itself is the counter: it moves away from its first value.
  load(board, {
                  0xE59F0010,  // ldr r0, [pc, #16]
                  0xE5901000,  // ldr r1, [r0]
                  0xE2811001,  // add r1, r1, #1
                  0xE5801000,  // str r1, [r0]
                  0xE3A01000,  // mov r1, #0
                  0xEAFFFFFA,  // b ldr r1
                  0x8000001C,
                  0x00000000,
              });
  board.run_until(kTick_ns);
  const auto bytes = board.memory(kSmallImageAddress + 0x1C, 4);
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(bytes[i]); };
  const std::uint32_t count = byte(0) | byte(1) << 8U | byte(2) << 16U;
  EXPECT_NEAR(count, kTick_ns / (5.0 * kInstruction_ns), 100);
}

TEST(Board, ResetStartsTheImageAgainAndAnUntouchedOneTwiceGivesTheSame) {
  Board board;
  load(board, {0xE3A00001, 0xFFFFFFFF});
  board.run_until(kTick_ns);
  ASSERT_TRUE(board.verdict());
  board.power_off();
  board.run_until(2 * kTick_ns);
  EXPECT_FALSE(board.is_on());
  board.reset();
  EXPECT_FALSE(board.verdict());
  board.run_until(3 * kTick_ns);
  ASSERT_TRUE(board.verdict());
  EXPECT_EQ(board.verdict()->pc, kSmallImageAddress + 4);
}

TEST(Board, RefusesAnImageOutsideItsMemory) {
  Board board;
  auto image = ElfImage::parse(small_image({0xEAFFFFFE}, 0x1000));
  ASSERT_TRUE(image);
  EXPECT_NE(board.load(std::move(*image)), "");
}

TEST(Board, AStuckBitShowsInEveryRead) {
  Board board;
  // Reads GPIO1's DATAIN and jumps nowhere when bit 14 is set.
  load(board, {
                  0xE59F0010,  // ldr r0, [pc, #16]
                  0xE5901000,  // ldr r1, [r0]
                  0xE3110901,  // tst r1, #0x4000
                  0x0AFFFFFC,  // beq ldr
                  0xE3A0F000,  // mov pc, #0
                  0x00000000,
                  0x4804C138,
              });
  board.run_until(kTick_ns);
  EXPECT_FALSE(board.verdict());
  board.stick({.address = 0x4804'C138, .bit = 14, .high = true});
  board.gpio(1).drive(0, true, board.now_ns());  // wakes the idle loop
  board.run_until(3 * kTick_ns);
  EXPECT_TRUE(board.verdict());
}

}  // namespace
}  // namespace towbench::board
