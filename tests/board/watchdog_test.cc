// The watchdog against the arithmetic of the TRM, and what a register that is merely kept does to a
// run.
#include "board/watchdog.h"

#include <gtest/gtest.h>

#include "board/board.h"
#include "tests/board/small_image.h"

namespace towbench::board {
namespace {

constexpr std::uint32_t kWdtControl = 0x24;
constexpr std::uint32_t kWdtCounter = 0x28;
constexpr std::uint32_t kWdtLoad = 0x2C;
constexpr std::uint32_t kWdtTrigger = 0x30;
constexpr std::uint32_t kWdtStartStop = 0x48;

class WatchdogInTime {
 public:
  void write(std::uint32_t offset, std::uint32_t value) { watchdog_.store(offset, 4, value); }
  std::uint32_t read(std::uint32_t offset) { return watchdog_.load(offset, 4); }
  void to(double time_s) { watchdog_.advance(core::nanoseconds(time_s)); }
  // `ticks` of 2^prescale clocks before the overflow.
  void arm(std::uint32_t ticks, std::uint32_t prescale) {
    write(kWdtControl, 1U << 5U | prescale << 2U);
    write(kWdtLoad, 0U - ticks);
    write(kWdtTrigger, ++trigger_);
    write(kWdtStartStop, 0xBBBB);
    write(kWdtStartStop, 0x4444);
  }
  void serve() { write(kWdtTrigger, ++trigger_); }
  Watchdog& operator*() { return watchdog_; }

 private:
  Bus bus_;
  Watchdog watchdog_{"watchdog", 0x1000, bus_};
  std::uint32_t trigger_ = 0;
};

TEST(Watchdog, StandsUntilItIsStarted) {
  WatchdogInTime watchdog;
  watchdog.to(1000.0);
  EXPECT_FALSE((*watchdog).expired());
  EXPECT_EQ((*watchdog).next_event_ns(), kNever);
}

TEST(Watchdog, ExpiresAfterItsTicksAndNotBefore) {
  WatchdogInTime watchdog;
  watchdog.arm(16'384, 0);  // half a second
  EXPECT_EQ((*watchdog).next_event_ns(), core::kNanosecondsPerSecond / 2);
  watchdog.to(0.4999);
  EXPECT_FALSE((*watchdog).expired());
  watchdog.to(0.5);
  EXPECT_TRUE((*watchdog).expired());
}

TEST(Watchdog, ThePrescalerMakesEachTickLonger) {
  WatchdogInTime watchdog;
  watchdog.arm(4'096, 3);  // 4096 x 8 clocks: a second
  watchdog.to(0.5);
  EXPECT_EQ(watchdog.read(kWdtCounter), 0U - 2'048U);
  watchdog.to(0.9999);
  EXPECT_FALSE((*watchdog).expired());
  watchdog.to(1.0);
  EXPECT_TRUE((*watchdog).expired());
}

TEST(Watchdog, IsServedByAnotherValueAndNotByTheSame) {
  WatchdogInTime watchdog;
  watchdog.arm(16'384, 0);
  watchdog.to(0.4);
  watchdog.serve();
  watchdog.to(0.8);
  EXPECT_FALSE((*watchdog).expired());
  watchdog.write(kWdtTrigger, watchdog.read(kWdtTrigger));
  watchdog.to(0.91);
  EXPECT_TRUE((*watchdog).expired());
}

TEST(Watchdog, StopsOnTheWholeSequenceOnly) {
  WatchdogInTime watchdog;
  watchdog.arm(16'384, 0);
  watchdog.to(0.1);
  watchdog.write(kWdtStartStop, 0x5555);
  EXPECT_NE((*watchdog).next_event_ns(), kNever);
  watchdog.write(kWdtStartStop, 0xAAAA);
  watchdog.write(kWdtStartStop, 0x5555);
  watchdog.to(10.0);
  EXPECT_FALSE((*watchdog).expired());
}

void run_image(Board& board, const std::vector<std::uint32_t>& code, double until_s) {
  auto image = ElfImage::parse(small_image(code));
  ASSERT_TRUE(image);
  ASSERT_EQ(board.load(std::move(*image)), "");
  while (board.now_ns() < core::nanoseconds(until_s)) {
    board.run_until(board.now_ns() + core::kPlantTick_ns);
  }
}

TEST(Watchdog, ResetsAnImageThatDoesNotServeIt) {
  Board board;
  run_image(board,
            {
                0xE59F0018,  // ldr r0, [pc, #24]   the watchdog
                0xE59F1018,  // ldr r1, [pc, #24]   0xBBBB
                0xE59F2018,  // ldr r2, [pc, #24]   0x4444
                0xE59F3018,  // ldr r3, [pc, #24]   a tenth of a second
                0xE5803028,  // str r3, [r0, #0x28]
                0xE5801048,  // str r1, [r0, #0x48]
                0xE5802048,  // str r2, [r0, #0x48]
                0xEAFFFFFE,  // b .
                0x44E35000,
                0x0000BBBB,
                0x00004444,
                0xFFFFF333,
            },
            0.55);
  EXPECT_EQ(board.watchdog_resets(), 5U);
  EXPECT_FALSE(board.verdict()) << board.verdict()->sentence;
}

// Reads the ADC's FIFO twice and stores the sum.
TEST(KeptRegisters, AValueThatIsReadAgainAndWasNeverWrittenMakesTheRunDoubtful) {
  Board board;
  run_image(board,
            {
                0xE59F000C,  // ldr r0, [pc, #12]
                0xE5901100,  // ldr r1, [r0, #0x100]
                0xE5902100,  // ldr r2, [r0, #0x100]
                0xE0811002,  // add r1, r1, r2
                0xEAFFFFFE,  // b .
                0x44E0D000,
            },
            1e-3);
  EXPECT_NE(board.doubt().find("register 0x100 of adc (0x44e0d100)"), std::string::npos)
      << board.doubt();
  EXPECT_NE(board.doubt().find("(start"), std::string::npos) << board.doubt();
  EXPECT_EQ(board.notes(), std::vector<std::string>{"adc: register 0x100 is read, not modelled"});
}

// Waits for the eCAP's event flag, ECFLG.
TEST(KeptRegisters, AnEcapThatIsPolledIsToldByName) {
  Board board;
  run_image(board,
            {
                0xE59F000C,  // ldr r0, [pc, #12]   PWMSS1
                0xE590112C,  // loop: ldr r1, [r0, #0x12C]
                0xE1A01821,  // lsr r1, r1, #16
                0xE3510000,  // cmp r1, #0
                0x0AFFFFFB,  // beq loop
                0x48302000,
            },
            1e-3);
  EXPECT_EQ(board.doubt(),
            "at 0x80000004 (start+0x4) the image goes by register 0x2c of ecap1 (0x4830212c), "
            "which is not modelled");
}

// Sets the clock to 2 s and reads it: what was written is not what the clock would show.
TEST(KeptRegisters, ATimeThatIsReadOnceMakesTheRunDoubtfulThoughItWasWritten) {
  Board board;
  run_image(board,
            {
                0xE59F000C,  // ldr r0, [pc, #12]
                0xE3A01002,  // mov r1, #2
                0xE5801000,  // str r1, [r0]
                0xE5902000,  // ldr r2, [r0]
                0xEAFFFFFE,  // b .
                0x44E3E000,
            },
            1e-3);
  EXPECT_NE(board.doubt().find("register 0x0 of rtc (0x44e3e000)"), std::string::npos)
      << board.doubt();
}

TEST(KeptRegisters, AReadThatAWriteFollowsIsNotedAndNoMore) {
  Board board;
  run_image(board,
            {
                0xE59F0010,  // ldr r0, [pc, #16]
                0xE5901040,  // ldr r1, [r0, #0x40]
                0xE3811001,  // orr r1, r1, #1
                0xE5801040,  // str r1, [r0, #0x40]
                0xE5901040,  // ldr r1, [r0, #0x40]
                0xEAFFFFFE,  // b .
                0x44E0D000,
            },
            1e-3);
  EXPECT_EQ(board.doubt(), "");
  EXPECT_EQ(board.notes().size(), 2U) << "one for the read, one for the write";
}

}  // namespace
}  // namespace towbench::board
