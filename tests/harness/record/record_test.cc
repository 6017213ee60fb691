#include <charconv>
#include <fstream>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "harness/files/csv_table.h"
#include "harness/record/csv_writer.h"
#include "harness/record/event_lines.h"
#include "harness/record/junit.h"
#include "harness/record/line_writer.h"
#include "harness/record/log_columns.h"
#include "harness/record/run_folder.h"
#include "tests/harness/fixtures/temporary_fixtures.h"

namespace towbench::harness {
namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream stream(path);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::string seconds_text(core::Nanoseconds time_ns) {
  std::array<char, kLongestSeconds> text{};
  return {text.data(), write_seconds(text.data(), time_ns)};
}

TEST(Seconds, AreExactAndShort) {
  EXPECT_EQ(seconds_text(0), "0");
  EXPECT_EQ(seconds_text(1'000'000'000), "1");
  EXPECT_EQ(seconds_text(1'500'000'000), "1.5");
  EXPECT_EQ(seconds_text(100'000), "0.0001");
  EXPECT_EQ(seconds_text(1), "0.000000001");
  EXPECT_EQ(seconds_text(-2'000'000'001), "-2.000000001");
  EXPECT_EQ(seconds_text(std::numeric_limits<core::Nanoseconds>::max()), "9223372036.854775807");
}

TEST(CsvWriter, EveryDoubleReadsBackAsTheSameBits) {
  const TemporaryFixtures files;
  const auto path = files.folder() / "numbers.csv";
  core::Random random(7);
  std::vector<double> numbers{0.0, 1.0, -1.0, 0.1, 1e300, 5e-324, 1.0 / 3.0, 2.2454528388231136e-6};
  while (numbers.size() < 10'000) {
    const double number = std::bit_cast<double>(random.bits());
    if (std::isfinite(number)) {
      numbers.push_back(number);
    }
  }
  {
    CsvWriter csv(path, "a,b");
    for (std::size_t i = 0; i < numbers.size(); i += 2) {
      csv.number(numbers[i]).number(numbers[i + 1]).end_row();
    }
    EXPECT_EQ(csv.rows(), numbers.size() / 2);
  }
  const auto table = CsvTable::load(path);
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    ASSERT_EQ(table.column("a")[i / 2], numbers[i]);
    ASSERT_EQ(table.column("b")[i / 2], numbers[i + 1]);
  }
}

TEST(CsvWriter, AFullDiskIsNoticed) {
  if (!std::filesystem::exists("/dev/full")) {
    GTEST_SKIP() << "/dev/full does not exist here";
  }
  CsvWriter csv("/dev/full", "a");
  EXPECT_FALSE(csv.good());
  LineWriter lines("/dev/full");
  lines.write("text");
  lines.flush();
  EXPECT_FALSE(lines.good());
}

TEST(CsvWriter, AFileThatCannotBeMadeIsAnError) {
  EXPECT_THROW(CsvWriter("no/such/folder/log.csv", "a"), std::filesystem::filesystem_error);
}

TEST(LogColumns, AreThoseOfTheConventions) {
  EXPECT_EQ(log_header(),
            "time_s,y_reference_m,y_reference_velocity_m_per_s,y_count,y_position_m,"
            "y_velocity_m_per_s,y_duty_pct,y_state,y_edges,x_reference_m,"
            "x_reference_velocity_m_per_s,x_count,x_position_m,x_velocity_m_per_s,x_duty_pct,"
            "x_state,x_edges,fault");
}

TEST(LogColumns, ARowIsWrittenByTheByte) {
  const TemporaryFixtures files;
  {
    CsvWriter csv(files.folder() / "log.csv", log_header());
    bbmc::TelemetryRow row;
    row.time_ns = 1'001'000'000;
    row.fault = core::ErrorCode::kFaultKillSwitch;
    auto& y = row.axes[core::Axis::kY];
    y.reference_m = 0.25;
    y.count = -12;
    y.duty_pct = -99.9;
    y.edges = 400;
    y.mode = bbmc::AxisMode::kBraking;
    write_log_row(csv, row);
  }
  EXPECT_EQ(contents(files.folder() / "log.csv"),
            log_header() + "\n1.001,0.25,0,-12,0,0,-99.9,4,400,0,0,0,0,0,0,0,0,300\n");
}

TEST(Events, OfBothSidesAreMergedByTimeAndTheTornLastOneIsDropped) {
  const TemporaryFixtures files;
  files.write(kPlantEventsFile,
              event_line(emulator::PlantEvent{.time_ns = 1'000'000,
                                              .kind = emulator::PlantEventKind::kHardEndContact,
                                              .code = core::ErrorCode::kHardEndContact,
                                              .value = 0.25}) +
                  event_line(emulator::PlantEvent{.time_ns = 3'000'000}) + "{\"time_s\":4,\"si");
  files.write(kControllerEventsFile,
              wire_event_line(2'000'000, "duty_zero") + wire_event_line(3'000'000, "duty_on"));
  merge_events(files.folder());
  EXPECT_EQ(contents(files.folder() / kEventsFile),
            "{\"time_s\":0.001,\"side\":\"plant\",\"kind\":\"hard_end_contact\",\"axis\":\"y\","
            "\"code\":501,\"text\":\"contact with a hard "
            "end\",\"lines\":0,\"value\":0.25,\"energy_J\":0}\n"
            "{\"time_s\":0.002,\"side\":\"wire\",\"kind\":\"duty_zero\"}\n"
            "{\"time_s\":0.003,\"side\":\"plant\",\"kind\":\"finished\",\"axis\":\"y\",\"lines\":0,"
            "\"value\":0,\"energy_J\":0}\n"
            "{\"time_s\":0.003,\"side\":\"wire\",\"kind\":\"duty_on\"}\n");
  EXPECT_FALSE(std::filesystem::exists(files.folder() / kPlantEventsFile));
}

TEST(RunFolder, TwoOfTheSameSecondAreTwo) {
  const TemporaryFixtures files;
  const auto first = create_run_folder(files.folder(), "t", "12345678");
  const auto second = create_run_folder(files.folder(), "t", "12345678");
  EXPECT_NE(first, second);
  EXPECT_TRUE(std::filesystem::is_directory(second));
}

TEST(RunFolder, CopiesKeepTheirPlacesRelativeToEachOther) {
  const TemporaryFixtures files;
  const auto first = copy_inputs(
      {{"/a/fixtures/experiments/e.toml", "E"}, {"/a/fixtures/rigs/r.toml", "R"}}, files.folder());
  EXPECT_EQ(first, "inputs/experiments/e.toml");
  EXPECT_EQ(contents(files.folder() / "inputs/rigs/r.toml"), "R");
}

TEST(Junit, EscapesAndCounts) {
  Check failed;
  failed.name = "a<b";
  failed.window = "whole";
  failed.verdict = Verdict::kFail;
  failed.reason = "\"x\" & y";
  Check passed;
  passed.name = "ok";
  passed.verdict = Verdict::kPass;
  const auto xml = junit_xml("suite", 1.5, std::vector<Check>{failed, passed, Check{}});
  EXPECT_THAT(xml, ::testing::HasSubstr("tests=\"3\" failures=\"1\" errors=\"1\""));
  EXPECT_THAT(xml, ::testing::HasSubstr("a&lt;b over whole"));
  EXPECT_THAT(xml, ::testing::HasSubstr("&quot;x&quot; &amp; y"));
}

TEST(WriteAtomically, LeavesNoPartBehind) {
  const TemporaryFixtures files;
  write_atomically(files.folder() / "r.json", "one");
  write_atomically(files.folder() / "r.json", "two");
  EXPECT_EQ(contents(files.folder() / "r.json"), "two");
  EXPECT_FALSE(std::filesystem::exists(files.folder() / "r.json.part"));
}

}  // namespace
}  // namespace towbench::harness
