// Input that nobody sends by mistake: each ends at once, in one line, with exit code 2.
#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/harness/end_to_end/run_support.h"
#include "tests/support/program_output.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

tests::ProgramOutput refused(const std::string& arguments) {
  return tests::output_of("timeout 10 " + tests::quoted(TOWBENCH_PROGRAM) + " " + arguments);
}

TEST(HardInput, ValuesThatAreNoneAreBadArguments) {
  for (const char* arguments :
       {"run circle --seed -1", "run circle --seed 1e3", "run circle --seed nan",
        "campaign standard --workers -1", "campaign standard --seeds -3", "doctor --seconds nan",
        "doctor --seconds inf", "doctor --seconds -1", "doctor --compare -1",
        "emulate --rig fixtures/rigs/macs-nominal.toml --listen local:/tmp/x --patience nan",
        "run circle --out README.md", "run circle --out README.md/below", "report no-such-folder",
        "replay no-such-folder"}) {
    EXPECT_EQ(refused(arguments).code, kExitBadInput) << arguments;
  }
}

TEST(HardInput, PipesDevicesAndDeepKeysAreRefusedAtOnce) {
  TemporaryFixtures files;
  const auto pipe = (files.folder() / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string deep;
  for (int i = 0; i < 50'000; ++i) {
    deep += "a.";
  }
  const auto deep_file = files.write("deep.toml", "schema = 1\n" + deep + "a = 1\n").string();
  for (const auto& file : {pipe, std::string("/dev/zero"), deep_file}) {
    const auto output = refused("validate " + file);
    EXPECT_EQ(output.code, kExitBadInput) << file;
    EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
  }
}

TEST(HardInput, APipeInARunFolderIsToldAndNotWaitedFor) {
  Runs runs;
  const auto run = runs.run("pulses");
  for (const char* name : {"log.csv", "truth.csv", "events.jsonl", "result.json"}) {
    const auto file = run.folder / name;
    const auto kept = contents_of(file);
    std::filesystem::remove(file);
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    EXPECT_EQ(refused("report " + run.folder.string()).code, kExitInvalid) << name;
    std::filesystem::remove(file);
    std::ofstream(file, std::ios::binary) << kept;
  }
}

TEST(HardInput, TwoPlantFilesThatDescribeTheSameAxisAreRefused) {
  TemporaryFixtures files;
  const auto plant =
      std::filesystem::proximate("fixtures/plants/macs-nominal.toml", files.folder());
  const auto rig =
      files.write("rig.toml", "schema = 1\nname = \"two\"\nplants = [\"" + plant.string() +
                                  "\", \"" + plant.string() + "\"]\n");
  const auto output = refused("validate " + rig.string());
  EXPECT_EQ(output.code, kExitBadInput);
  EXPECT_THAT(output.text, HasSubstr("another plant file"));
}

TEST(HardInput, APlaceFarOutsideEveryHallIsRefused) {
  TemporaryFixtures files;
  const auto plant =
      std::filesystem::proximate("fixtures/plants/macs-nominal.toml", files.folder());
  const auto rig =
      files.write("rig.toml", "schema = 1\nname = \"far\"\nplants = [\"" + plant.string() +
                                  "\"]\n[axis.y.hall_max]\nposition_m = 1e300\n");
  const auto output = refused("validate " + rig.string());
  EXPECT_EQ(output.code, kExitBadInput);
  EXPECT_THAT(output.text, HasSubstr("position_m"));
}

TEST(HardInput, AFaultThatAPartCannotHaveIsToldWithItsPlace) {
  TemporaryFixtures files;
  const auto motion =
      std::filesystem::proximate("fixtures/experiments/trapezoid-400.toml", files.folder());
  const auto campaign =
      files.write("c.toml", "schema = 1\nname = \"c\"\nmotions = [\"" + motion.string() +
                                "\"]\n[[inject]]\nparts = [\"supply\"]\nkinds = [\"frozen\"]\n"
                                "phases = [\"cruise\"]\n");
  const auto output =
      refused("campaign " + campaign.string() + " --out " + files.folder().string());
  EXPECT_EQ(output.code, kExitBadInput);
  EXPECT_THAT(output.text, HasSubstr("c.toml:6"));
}

// A terminal that goes away ends a run as a signal to end does: what there is, is kept. Tests may
// be run below nohup, which a program inherits.
TEST(HardInput, AHangUpEndsARunInOrder) {
  TemporaryFixtures files;
  const auto output =
      tests::output_of("bash -c 'env --default-signal=HUP " + tests::quoted(TOWBENCH_PROGRAM) +
                       " run circles-20min --no-report -q --out " + files.folder().string() +
                       " & until ls " + files.folder().string() +
                       "/*/log.csv; do sleep 0.02; done >/dev/null 2>&1; kill -HUP $!; wait $!'");
  EXPECT_EQ(output.code, kExitRuntime) << output.text;
  for (const auto& entry : std::filesystem::directory_iterator(files.folder())) {
    EXPECT_EQ(json_of(entry.path() / "result.json").at("reason"), "interrupted");
  }
}

}  // namespace
}  // namespace towbench::harness
