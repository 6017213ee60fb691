// Real lines and a serial console as a user types them; what is refused, with which words.
#include <algorithm>
#include <array>
#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/link/pty_line.h"
#include "tests/harness/end_to_end/run_support.h"
#include "tests/support/program_output.h"

namespace towbench::harness {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

tests::ProgramOutput typed(const std::string& arguments) {
  return tests::output_of(tests::quoted(TOWBENCH_PROGRAM) + " " + arguments);
}

TEST(EncoderLinesOption, AnExperimentThatIsTooFastIsRefusedWithBothRates) {
  const auto output =
      typed("run trapezoid-400 --encoder-lines gpiochip0+9:index@20000,sim:gpiochip0+9:index");
  EXPECT_EQ(output.code, kExitBadInput);
  EXPECT_THAT(output.text, ContainsRegex("1[78][0-9]000 edges/s at its fastest .* the lines carry "
                                         "20000 edges/s .as rated."));
  EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
}

TEST(EncoderLinesOption, WhatIsNoPairOfPlacesIsRefused) {
  for (const char* text : {"gpiochip0", "gpiochip0,", "gpiochip0@0,gpiochip1",
                           "sim:gpiochip0,gpiochip0", "gpiochip0:index,sim:gpiochip0"}) {
    const auto output = typed(std::string("run circle --encoder-lines ") + text);
    EXPECT_EQ(output.code, kExitBadInput) << text << output.text;
    EXPECT_THAT(output.text, HasSubstr("--encoder-lines")) << text;
  }
}

TEST(EncoderLinesOption, AControllerThatExpectsAnIndexIsNotRunWithoutOne) {
  const auto output = typed("run circle --encoder-lines gpiochip0+9,sim:gpiochip0+9");
  EXPECT_EQ(output.code, kExitBadInput);
  EXPECT_THAT(output.text, HasSubstr("no index for a controller that expects one"));
}

TEST(EncoderLinesOption, FaultsAreRefusedBecauseTheirReferenceRunHasOtherBits) {
  const auto output = typed(
      "run wall-clock-window --encoder-lines gpiochip0+9:index,sim:gpiochip0+9:index --fault "
      "\"encoder.y "
      "frozen at=1s\"");
  EXPECT_EQ(output.code, kExitBadInput);
  EXPECT_THAT(output.text, HasSubstr("a run with its encoders on lines"));
}

TEST(LinesOption, ADebounceInLockstepIsRefused) {
  const auto output = typed("run circle --lines gpiochip0~5,sim:gpiochip0");
  EXPECT_EQ(output.code, kExitBadInput);
  EXPECT_THAT(output.text, HasSubstr("host's clock"));
}

TEST(SerialConsole, ASessionIsTypedAtTheFarEndOfTheLine) {
  const PtyLine line;
  const auto output =
      tests::output_of("python3 tests/carriers/typing_operator.py " + line.far_end() +
                       " 'reset poscalib y 0.449092m' 'reset poscalib x 0.336819m'"
                       " 'run -trapez y --distance 0.02m --speed 0.05m/s' quit & operator=$!; " +
                       tests::quoted(TOWBENCH_PROGRAM) +
                       " control --controller fixtures/controllers/bbmc-tuned.toml"
                       " --rig fixtures/rigs/macs-nominal.toml --fast --console serial:" +
                       line.near_end() + " && wait $operator");
  EXPECT_EQ(output.code, 0) << output.text;
  EXPECT_THAT(output.text, HasSubstr("moving for 1.20s\r\ndone\r\nok"));
}

TEST(SerialConsole, WhatIsNoSerialLineIsRefused) {
  const auto output = typed(
      "control --controller fixtures/controllers/bbmc-tuned.toml"
      " --rig fixtures/rigs/macs-nominal.toml --console can:vcan0");
  EXPECT_EQ(output.code, kExitBadInput);
  EXPECT_THAT(output.text, HasSubstr("serial:DEVICE[@BAUD]"));
}

}  // namespace
}  // namespace towbench::harness
