// The manifest of a run folder: what replay and report say of changed, forged and foreign records.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/panel/panel_json.h"
#include "harness/proof/run_manifest.h"
#include "tests/harness/end_to_end/run_support.h"
#include "tests/support/program_output.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

namespace fs = std::filesystem;

void store(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

void replace_in(const fs::path& file, const std::string& old_text, const std::string& new_text) {
  auto text = contents_of(file);
  const auto at = text.find(old_text);
  ASSERT_NE(at, std::string::npos) << file << " lacks " << old_text;
  store(file, text.replace(at, old_text.size(), new_text));
}

class Manifest : public ::testing::Test {
 protected:
  // `environment`: assignments in front of the program.
  static tests::ProgramOutput bench(const std::string& words, const std::string& environment = "") {
    return tests::output_of("env " + environment + " " + tests::quoted(TOWBENCH_PROGRAM) + " " +
                            words);
  }

  Runs runs_;
  fs::path folder_ = runs_.run("pulses").folder;
};

TEST_F(Manifest, ReplayRefusesAWidenedBudget) {
  replace_in(folder_ / "inputs/experiments/pulses.toml", "[[budget]]", "[[budget]]\n#");
  const auto output = bench("replay " + folder_.string());
  EXPECT_EQ(output.code, kExitInvalid);
  EXPECT_THAT(output.text, HasSubstr("inputs/experiments/pulses.toml has"));
}

TEST_F(Manifest, ReplayRefusesAnEditedPlant) {
  for (const auto& entry : fs::directory_iterator(folder_ / "inputs/plants")) {
    store(entry.path(), contents_of(entry.path()) + "\n");
  }
  EXPECT_EQ(bench("replay " + folder_.string()).code, kExitInvalid);
}

TEST_F(Manifest, ReplayRefusesAnEditedVerdict) {
  replace_in(folder_ / "result.json", "\"verdict\": \"PASS\"", "\"verdict\": \"FAIL\"");
  EXPECT_EQ(bench("replay " + folder_.string()).code, kExitInvalid);
}

TEST_F(Manifest, ReplayJudgesAgainWhatWasForgedWithTheKey) {
  auto result = json_of(folder_ / "result.json");
  result.at("checks")[0]["max"] = 1e9;
  store(folder_ / "result.json", result.dump(2));
  write_manifest(folder_);
  const auto output = bench("replay " + folder_.string());
  EXPECT_EQ(output.code, kExitFail);
  EXPECT_THAT(output.text, HasSubstr("result.json differs in its checks"));
}

TEST_F(Manifest, HashesEditedWithoutTheKeyAreTold) {
  replace_in(folder_ / "manifest.json", "\"console.txt\"", "\"console.tx_\"");
  fs::rename(folder_ / "console.txt", folder_ / "console.tx_");
  const auto output = bench("report " + folder_.string());
  EXPECT_EQ(output.code, kExitInvalid);
  EXPECT_THAT(output.text, HasSubstr("manifest.json was changed after it was signed"));
}

TEST_F(Manifest, ARecordFromAnotherMachineIsCheckedAndItsOriginUnknown) {
  const auto other = "XDG_STATE_HOME=" + (runs_.folder() / "state").string();
  EXPECT_EQ(bench("report " + folder_.string(), other).code, kExitPass);
  EXPECT_THAT(contents_of(folder_ / "report.html").find("not under this user&#39;s key") !=
                      std::string::npos ||
                  contents_of(folder_ / "report.html").find("not under this user's key") !=
                      std::string::npos,
              true);
  store(folder_ / "console.txt", "changed");
  EXPECT_EQ(bench("report " + folder_.string(), other).code, kExitInvalid);
}

TEST_F(Manifest, AFileThatWasNotRecordedIsTold) {
  store(folder_ / "timing2.csv", "time_s\n");
  EXPECT_THAT(bench("report " + folder_.string()).text,
              HasSubstr("timing2.csv was not recorded with this run"));
}

TEST_F(Manifest, ThePanelsListShowsNoEditedVerdict) {
  replace_in(folder_ / "result.json", "\"seed\": 1", "\"seed\": 2");
  const auto listed = nlohmann::json::parse(folders_json(runs_.folder()));
  EXPECT_EQ(listed.at(0).at("verdict"), "INVALID");
}

}  // namespace
}  // namespace towbench::harness
