// A run folder that does not agree with itself never shows a pass: `report` says so and ends
// with 4.

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/end_to_end/run_support.h"
#include "tests/support/program_output.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

void put(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

struct Attack {
  const char* name;
  std::function<void(const fs::path& folder)> make;
};

void raise_a_value(const fs::path& folder, double value) {
  auto result = json_of(folder / "result.json");
  for (auto& check : result.at("checks")) {
    if (check.at("max").is_number()) {
      check["value"] = value;
    }
  }
  put(folder / "result.json", result.dump(2));
}

const std::vector<Attack>& attacks() {
  static const std::vector<Attack> kAttacks{
      {"log emptied", [](const fs::path& f) { put(f / "log.csv", ""); }},
      {"truth emptied", [](const fs::path& f) { put(f / "truth.csv", ""); }},
      {"log deleted", [](const fs::path& f) { fs::remove(f / "log.csv"); }},
      {"log halved",
       [](const fs::path& f) {
         const auto text = contents_of(f / "log.csv");
         put(f / "log.csv", text.substr(0, text.find('\n', text.size() / 2) + 1));
       }},
      {"random bytes in the truth",
       [](const fs::path& f) {
         auto text = contents_of(f / "truth.csv");
         text.replace(text.size() / 2, 6, "\x93\xff\x01\n\x7f,");
         put(f / "truth.csv", text);
       }},
      {"a value beyond its limit", [](const fs::path& f) { raise_a_value(f, 1e9); }},
      {"a value that no row shows", [](const fs::path& f) { raise_a_value(f, 1e-12); }},
      {"a metric that no row shows",
       [](const fs::path& f) {
         auto metrics = json_of(f / "metrics.json");
         metrics.at("metrics")[0]["value"] = 1e-12;
         put(f / "metrics.json", metrics.dump(2));
       }},
      {"metrics deleted", [](const fs::path& f) { fs::remove(f / "metrics.json"); }},
      {"an event less",
       [](const fs::path& f) {
         const auto text = contents_of(f / "events.jsonl");
         put(f / "events.jsonl", text.substr(text.find('\n') + 1));
       }},
      {"result deleted", [](const fs::path& f) { fs::remove(f / "result.json"); }},
  };
  return kAttacks;
}

class ReportAgreement : public ::testing::Test {
 protected:
  fs::path attacked(const Attack& attack) {
    const auto folder = runs_.folder() / "attacked";
    fs::remove_all(folder);
    fs::copy(recorded_, folder, fs::copy_options::recursive);
    attack.make(folder);
    return folder;
  }

  Runs runs_;
  fs::path recorded_ = runs_.run("pulses").folder;
};

tests::ProgramOutput report(const fs::path& folder) {
  return tests::output_of(tests::quoted(TOWBENCH_PROGRAM) + " report " + folder.string());
}

TEST_F(ReportAgreement, OfASoundFolderIsAPass) {
  const auto output = report(recorded_);
  EXPECT_EQ(output.code, kExitPass) << output.text;
  EXPECT_THAT(contents_of(recorded_ / "report.html"), HasSubstr("data-verdict=\"PASS\""));
}

TEST_F(ReportAgreement, EveryChangedFolderIsToldSo) {
  for (const auto& attack : attacks()) {
    const auto folder = attacked(attack);
    const auto output = report(folder);
    EXPECT_EQ(output.code, kExitInvalid) << attack.name << ": " << output.text;
    EXPECT_THAT(contents_of(folder / "report.html").find("data-verdict=\"PASS\""),
                std::string::npos)
        << attack.name;
  }
}

}  // namespace
}  // namespace towbench::harness
