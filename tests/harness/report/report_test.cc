#include "harness/report/report.h"

#include <array>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/report/assets.h"
#include "tests/harness/report/synthetic_run.h"

namespace towbench::harness {
namespace {

namespace fs = std::filesystem;

class Report : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    root_ =
        fs::temp_directory_path() / fmt::format("towbench-report-{}-{}", info->name(), ::getpid());
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  [[nodiscard]] fs::path folder(const std::string& name = "run") const { return root_ / name; }

  std::string page_of(const fs::path& run_folder) {
    const ReportResult written = write_report(run_folder);
    EXPECT_TRUE(written) << (written ? "" : written.error());
    return written ? test::read_text(written->page) : std::string{};
  }

 private:
  fs::path root_;
};

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

// Not a matcher: a failure must name what is missing, not print a megabyte of page.
void expect_parts(const std::string& page, std::initializer_list<std::string> parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(page.find(part), std::string::npos) << "the page lacks: " << part;
  }
}

TEST_F(Report, IsTheSameBytesForTheSameFolder) {
  test::write_synthetic_run(folder(), {.rows = 500});
  EXPECT_TRUE(page_of(folder()) == page_of(folder()));
}

TEST_F(Report, ShowsVerdictAndNumbersWithoutItsScript) {
  test::write_synthetic_run(folder(), {});
  expect_parts(page_of(folder()),
               {"data-verdict=\"PASS\"", "y tracking error peak", "0.4021\u00a0mm", "≤ 1\u00a0mm",
                "9f86d081884c7d65", "./towbench replay runs/run"});
}

TEST_F(Report, OfTwentySecondsAtOneKilohertzStaysBelowSixMegabytes) {
  test::write_synthetic_run(folder(), {.rows = 20'000});
  EXPECT_LT(page_of(folder()).size(), 6'000'000U);
}

TEST_F(Report, OfAVeryLongRunStaysBelowSixMegabytesToo) {
  test::write_synthetic_run(folder(), {.rows = 150'000});
  EXPECT_LT(page_of(folder()).size(), 6'000'000U);
}

TEST_F(Report, LetsNothingThatTheRunWroteBecomeMarkup) {
  test::SyntheticRun plain{.rows = 50};
  test::write_synthetic_run(folder("plain"), plain);
  const std::string hostile = "</script></style></pre><script>bad()</script><img onerror=bad()>";
  test::SyntheticRun run{.rows = 50,
                         .title = hostile,
                         .description = hostile,
                         .console = hostile,
                         .event_text = hostile};
  test::write_synthetic_run(folder("hostile"), run);
  const std::string expected = page_of(folder("plain"));
  const std::string page = page_of(folder("hostile"));
  for (const char* tag : {"<script", "</script", "<img", "</style", "</pre"}) {
    EXPECT_EQ(count_of(page, tag), count_of(expected, tag)) << tag;
  }
}

TEST_F(Report, AllowsItsOwnScriptOnly) {
  test::write_synthetic_run(folder(), {.rows = 50});
  const std::string page = page_of(folder());
  const bool has_script = !report::script_asset().text.empty();
  expect_parts(page,
               {"default-src 'none'", has_script ? "script-src 'sha256-" : "script-src 'none'"});
  EXPECT_EQ(count_of(page, "script-src 'unsafe-inline'"), 0U);
}

TEST_F(Report, SaysThatItHasNoPlotsWhenBuiltWithoutItsScript) {
  test::write_synthetic_run(folder(), {.rows = 50});
  const bool has_script = !report::script_asset().text.empty();
  EXPECT_EQ(count_of(page_of(folder()), "TOWBENCH_REPORT_ASSETS is OFF"), has_script ? 0U : 1U);
}

TEST_F(Report, OfAnEmptyFolderSaysWhatIsMissingAndNeverPasses) {
  fs::create_directories(folder());
  const std::string page = page_of(folder());
  expect_parts(page,
               {"data-verdict=\"INCOMPLETE\"", "result.json is missing",
                "log.csv is missing: nothing can be plotted.", "No check was judged in this run.",
                "No event was recorded.", "console.txt is missing."});
  EXPECT_EQ(count_of(page, "data-verdict=\"PASS\""), 0U);
}

TEST_F(Report, OfAKilledRunReadsWhatBothSidesLeft) {
  test::write_synthetic_run(folder(), {.rows = 300});
  auto result = test::synthetic_result({});
  result["status"] = "incomplete";
  result["reason"] = "the run was killed";
  result.erase("verdict");
  test::write_text(folder() / "result.json", result.dump());
  fs::remove(folder() / "metrics.json");
  fs::remove(folder() / "manifest.json");
  fs::rename(folder() / "events.jsonl", folder() / "plant_events.jsonl");
  const std::string log = test::read_text(folder() / "log.csv");
  test::write_text(folder() / "log.csv", log.substr(0, log.size() - 7));
  expect_parts(page_of(folder()), {"data-verdict=\"INCOMPLETE\"", "the run was killed",
                                   "log.csv: the last line is cut off", "soft limit",
                                   "No metric was computed for this run."});
}

// What the scripts draw in rad instead of metres; a page without them carries no data.
TEST_F(Report, TellsThePageWhichAxisTurns) {
  test::write_synthetic_run(folder(), {.rows = 300});
  EXPECT_EQ(count_of(page_of(folder()), R"("turns")"), 0U);
  auto result = test::synthetic_result({});
  result["limits"]["y"]["turns"] = true;
  test::write_text(folder() / "result.json", result.dump());
  const bool has_script = !report::script_asset().text.empty();
  EXPECT_EQ(count_of(page_of(folder()), R"("turns":true)"), has_script ? 1U : 0U);
}

TEST_F(Report, SurvivesFilesOfTheWrongKind) {
  fs::create_directories(folder());
  test::write_text(folder() / "result.json", R"({"status": 3, "checks": {"a": 1}, "limits": [],
    "experiment": "x", "machine": [1, [2]], "seed": {"a": null}})");
  test::write_text(folder() / "metrics.json", "[1, 2");
  test::write_text(folder() / "log.csv", std::string("\0\xff\n,,\n\n1", 8));
  test::write_text(folder() / "truth.csv", "a\n1\n");
  test::write_text(folder() / "timing.csv", "\n");
  test::write_text(folder() / "events.jsonl", "3\n{\"time_s\": \"x\", \"lines\": {}}\n{\n");
  expect_parts(page_of(folder()), {"data-verdict=\"INCOMPLETE\""});
}

TEST_F(Report, RefusesAFolderThatDoesNotExist) {
  EXPECT_FALSE(write_report(folder("nowhere")));
  EXPECT_FALSE(fs::exists(folder("nowhere")));
}

TEST_F(Report, OfSeveralRunsShowsTheWorstVerdictAndEveryRun) {
  test::write_synthetic_run(folder("a"), {.rows = 500, .title = "first"});
  test::SyntheticRun second{.rows = 500, .title = "second"};
  auto result = test::synthetic_result(second);
  result["verdict"] = "FAIL";
  result["checks"][0]["verdict"] = "FAIL";
  test::write_synthetic_run(folder("b"), second, result);
  const std::array folders{folder("a"), folder("b")};
  const ReportResult written = write_combined_report(folders, folder("all.html"));
  ASSERT_TRUE(written);
  const std::string page = test::read_text(written->page);
  EXPECT_LT(page.find("data-verdict=\"FAIL\""), page.find("data-verdict=\"PASS\""));
  expect_parts(page, {"1 of 2 runs passed.", "href=\"#run-2\"", "id=\"run-2\"", "first", "second"});
  // Each run is behind a fold; the one that failed is open.
  expect_parts(
      page, {"<details class=\"run\" id=\"run-1\">", "<details class=\"run\" id=\"run-2\" open>"});
  EXPECT_NE(page.find("Worst margin"), std::string::npos);
  EXPECT_LT(page.find("<section class=\"plots\">"), page.find("<section class=\"checks\">"));
}

TEST_F(Report, RefusesToCombineNothing) {
  EXPECT_FALSE(write_combined_report({}, folder("all.html")));
  EXPECT_FALSE(fs::exists(folder("all.html")));
}

}  // namespace
}  // namespace towbench::harness
