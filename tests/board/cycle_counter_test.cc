// The performance monitor's cycle counter, on images of a few instructions (the comments are the
// assembler's).
#include <array>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "board/board.h"
#include "tests/board/small_image.h"

namespace towbench::board {
namespace {

constexpr std::uint32_t kResults = 0x8000'1000;

// The words at kResults after a millisecond of `code`, which ends by storing r1 to r4 there.
std::array<std::uint32_t, 4> results_of(std::vector<std::uint32_t> code) {
  for (const std::uint32_t word : {
           0xE3A00102U,  // mov r0, #0x80000000
           0xE3800A01U,  // orr r0, r0, #0x1000
           0xE880001EU,  // stm r0, {r1-r4}
           0xEAFFFFFEU,  // b .
       }) {
    code.push_back(word);
  }
  Board board;
  auto image = ElfImage::parse(small_image(code));
  EXPECT_TRUE(image);
  EXPECT_EQ(board.load(std::move(*image)), "");
  board.run_until(core::kNanosecondsPerMillisecond);
  if (board.verdict()) {
    ADD_FAILURE() << board.verdict()->sentence;
  }
  std::array<std::uint32_t, 4> results{};
  std::memcpy(results.data(), board.memory(kResults, sizeof results).data(), sizeof results);
  return results;
}

constexpr std::uint32_t kWriteControl = 0xEE09'0F1C;  // mcr p15, 0, r0, c9, c12, 0
constexpr std::uint32_t kCountersOn = 0xEE09'0F3C;    // mcr p15, 0, r0, c9, c12, 1
constexpr std::uint32_t kCountersOff = 0xEE09'0F5C;   // mcr p15, 0, r0, c9, c12, 2
constexpr std::uint32_t kCounterToR1 = 0xEE19'1F1D;   // mrc p15, 0, r1, c9, c13, 0
constexpr std::uint32_t kCounterToR2 = 0xEE19'2F1D;   // mrc p15, 0, r2, c9, c13, 0
constexpr std::uint32_t kBit31ToR0 = 0xE3A0'0102;     // mov r0, #0x80000000
constexpr std::uint32_t kOneToR0 = 0xE3A0'0001;       // mov r0, #1
constexpr std::uint32_t kNothing = 0xE320'F000;       // nop

// Two cycles an instruction, by processor.h.
TEST(CycleCounter, CountsTheInstructionsBetweenTwoReads) {
  std::vector<std::uint32_t> code{kOneToR0, kWriteControl, kBit31ToR0, kCountersOn, kCounterToR1};
  code.insert(code.end(), 100, kNothing);
  code.push_back(kCounterToR2);
  const auto found = results_of(code);
  EXPECT_EQ(found[1] - found[0], 202U);
  EXPECT_LT(found[0], 10U) << "it began with its enable";
  EXPECT_EQ(results_of(code), found) << "the same twice";
}

TEST(CycleCounter, StandsUntilBothItsEnablesAreSet) {
  for (const auto enable : {kWriteControl, kCountersOn}) {
    std::vector<std::uint32_t> code{kBit31ToR0,   0xE3800001, enable,  // orr r0, r0, #1
                                    kCounterToR1, kNothing,   kNothing, kCounterToR2};
    const auto found = results_of(code);
    EXPECT_EQ(found[0], 0U);
    EXPECT_EQ(found[1], 0U);
  }
}

TEST(CycleCounter, IsLoadedResetAndStopped) {
  const std::vector<std::uint32_t> code{kOneToR0,      kWriteControl, kBit31ToR0, kCountersOn,
                                        0xEE090F1D,  // mcr p15, 0, r0, c9, c13, 0
                                        kCounterToR1,
                                        0xE3A00005,  // mov r0, #5: enable and reset
                                        kWriteControl, kCounterToR2,  kBit31ToR0, kCountersOff,
                                        0xEE193F1D,                  // mrc p15, 0, r3, c9, c13, 0
                                        kNothing,      0xEE194F1D};  // mrc p15, 0, r4, c9, c13, 0
  const auto found = results_of(code);
  EXPECT_EQ(found[0], 0x8000'0002U);
  EXPECT_EQ(found[1], 2U);
  EXPECT_EQ(found[2], 6U) << "two instructions later it stopped";
  EXPECT_EQ(found[3], found[2]);
}

TEST(CycleCounter, CountsOneInSixtyFour) {
  std::vector<std::uint32_t> code{0xE3A0000D,  // mov r0, #13: enable, reset, divide
                                  kWriteControl, kBit31ToR0, kCountersOn, kCounterToR1};
  code.insert(code.end(), 320, kNothing);
  code.push_back(kCounterToR2);
  const auto found = results_of(code);
  EXPECT_EQ(found[1] - found[0], 10U);
}

// A delay by the counter: longer than anything that its loop would take by itself.
TEST(CycleCounter, ALoopThatWaitsForItEnds) {
  const auto found = results_of({kOneToR0, kWriteControl, kBit31ToR0, kCountersOn, kCounterToR1,
                                 kCounterToR2,  // loop:
                                 0xE0423001,    // sub r3, r2, r1
                                 0xE3530A32,    // cmp r3, #204800
                                 0xBAFFFFFB});  // blt loop
  EXPECT_GE(found[2], 204'800U);
  EXPECT_LT(found[2], 204'900U);
}

TEST(CycleCounter, AnEventCounterThatIsReadIsDoubtful) {
  Board board;
  auto image =
      ElfImage::parse(small_image({0xEE190F5D, 0xEAFFFFFE}));  // mrc p15, 0, r0, c9, c13, 2
  ASSERT_TRUE(image);
  ASSERT_EQ(board.load(std::move(*image)), "");
  board.run_until(core::kNanosecondsPerMillisecond);
  EXPECT_EQ(board.doubt(),
            "at 0x80000000 (start) the image goes by an event counter of the performance monitor, "
            "which is not modelled");
}

}  // namespace
}  // namespace towbench::board
