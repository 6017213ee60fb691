// What an image that goes wrong is told, word by word: with its symbols and without.
#include <string>

#include <gtest/gtest.h>

#include "board/board.h"

namespace towbench::board {
namespace {

#ifdef TOWBENCH_FIRMWARE_FOLDER

// The verdict after typing that letter (none: '\0') to firmware misbehave.elf; empty when there is
// none in 3 s.
std::string told(char letter, const char* file = "/misbehave.elf") {
  auto image = ElfImage::read(std::string(TOWBENCH_FIRMWARE_FOLDER) + file);
  if (!image) {
    return image.error();
  }
  Board board;
  if (const auto refusal = board.load(std::move(*image)); !refusal.empty()) {
    return refusal;
  }
  if (letter != '\0') {
    board.uart().type(std::string(1, letter));
  }
  while (!board.verdict() && board.now_ns() < 3 * core::kNanosecondsPerSecond) {
    board.run_until(board.now_ns() + core::kPlantTick_ns);
  }
  return board.verdict() ? board.verdict()->sentence : std::string();
}

bool has(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

TEST(Misbehaviour, AReadOrWriteOfNothingNamesInstructionAddressAndFunctionInThumbCode) {
  EXPECT_TRUE(has(told('r'), "(read_of): it reads 0x70000008, where the board has nothing"))
      << told('r');
  EXPECT_TRUE(has(told('w'), "it writes 0x70000006, where the board has nothing")) << told('w');
  EXPECT_TRUE(has(told('w'), "(write_to+0x")) << told('w');
}

TEST(Misbehaviour, AJumpIntoNothingNamesWhereItMayHaveComeFrom) {
  const auto text = told('j');
  EXPECT_TRUE(has(text, "stopped at 0x20000000")) << text;
  EXPECT_TRUE(has(text, "LR is 0x8100")) << text;
  EXPECT_TRUE(has(text, "(main")) << text;
}

TEST(Misbehaviour, UndefinedInstructionsAreToldAndThoseOfASwitchedOffVfpAsSuch) {
  EXPECT_TRUE(has(told('u'), "(undefined_now+0x4): undefined instruction")) << told('u');
  EXPECT_TRUE(has(told('v'), "(vector_now): undefined instruction (of VFP or NEON")) << told('v');
}

TEST(Misbehaviour, WaitingForARegisterThatIsOnlyKeptIsToldAfterASecond) {
  const auto text = told('p');
  EXPECT_TRUE(has(text, "read register 0x24 of i2c0, which does not change by itself")) << text;
}

TEST(Misbehaviour, SpinningInMemoryWithInterruptsMaskedIsToldAfterASecond) {
  EXPECT_TRUE(has(told('m'), "with interrupts masked")) << told('m');
}

TEST(Misbehaviour, WaitingForTheConsoleWithInterruptsMaskedIsNone) {
  EXPECT_EQ(told('\0'), "") << "a prompt may stand for as long as nobody types";
}

TEST(Misbehaviour, WithoutSymbolsTheAddressesRemain) {
  const auto text = told('r', "/misbehave-stripped.elf");
  EXPECT_TRUE(has(text, "(no symbols): it reads 0x70000008")) << text;
}

#else

TEST(Misbehaviour, NeedsACrossCompiler) {
  GTEST_SKIP() << "no arm-none-eabi-gcc where this was built";
}

#endif

}  // namespace
}  // namespace towbench::board
