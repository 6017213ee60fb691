// What a campaign cannot write is not done: a torn line swallows no other, a full disk ends it.
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/checks/check.h"
#include "tests/harness/fixtures/temporary_fixtures.h"
#include "tests/support/program_output.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

namespace fs = std::filesystem;

tests::ProgramOutput bench(const std::string& words) {
  return tests::output_of(tests::quoted(TOWBENCH_PROGRAM) + " " + words);
}

std::string text_in(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Four cases.
const char* const kFew =
    "campaign standard --seeds 1 --workers 1 --quiet --only "
    "trapezoid-y/encoder.y.frozen/cruise --out ";

TEST(ResultsFile, ATornLastLineIsRunAgainAndSwallowsNoOther) {
  const TemporaryFixtures files;
  const auto results = files.folder() / "results.jsonl";
  const auto command = kFew + files.folder().string();
  ASSERT_EQ(bench(command).code, kExitPass);
  const auto whole = text_in(results);
  const auto last_line = whole.rfind('\n', whole.size() - 2) + 1;
  const auto torn = whole.substr(0, whole.size() - 20);
  std::ofstream(results, std::ios::binary) << torn;
  EXPECT_EQ(bench(command).code, kExitPass);
  EXPECT_EQ(text_in(results), torn + '\n' + whole.substr(last_line));
}

TEST(ResultsFile, AFullDiskEndsTheCampaign) {
  const TemporaryFixtures files;
  fs::create_symlink("/dev/full", files.folder() / "results.jsonl");
  const auto output = bench(kFew + files.folder().string());
  EXPECT_EQ(output.code, kExitRuntime);
  EXPECT_THAT(output.text, HasSubstr("cannot be written"));
}

// What was asked for and not tried is no pass.
TEST(EmptyEntry, IsInvalidByName) {
  const TemporaryFixtures files;
  const auto file = files.folder() / "two.toml";
  const auto motion =
      fs::proximate("fixtures/experiments/trapezoid-400.toml", files.folder()).string();
  std::ofstream(file) << "schema = 1\nname = \"two\"\nseeds = 1\nmotions = [\"" << motion
                      << "\"]\n[[inject]]\nparts = [\"encoder.y\"]\nkinds = [\"frozen\"]\n"
                         "phases = [\"cruise\"]\n[[inject]]\nparts = [\"encoder.y\"]\n"
                         "kinds = [\"missing_edges\"]\nphases = [\"no_such_phase\"]\n";
  const auto output = bench("campaign " + file.string() + " --workers 1 --out " +
                            (files.folder() / "out").string());
  EXPECT_EQ(output.code, kExitInvalid) << output.text;
  EXPECT_THAT(output.text, HasSubstr("INVALID  [[inject]] encoder.y missing_edges"));
}

TEST(StandardOutput, ThatCannotBeWrittenIsNoSuccess) {
  const TemporaryFixtures files;
  for (const std::string& words :
       {"run pulses --json --no-report --out " + files.folder().string(), std::string("list")}) {
    const auto output = bench(words + " 2>&1 >/dev/full");
    EXPECT_EQ(output.code, kExitRuntime) << words;
  }
}

}  // namespace
}  // namespace towbench::harness
