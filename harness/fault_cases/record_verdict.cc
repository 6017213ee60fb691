#include "harness/fault_cases/record_verdict.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "harness/fault_cases/requirements.h"
#include "harness/files/csv_table.h"
#include "harness/record/event_lines.h"

namespace towbench::harness {
namespace {

// Rows that wait in memory at most: a block on its way to the writer, one being filled, and what
// the writer's 64 KiB of text hold (record/row_block.h, csv_writer.h); at 1 kHz.
constexpr double kMostUnwritten_s = 1.5;

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

double last_time_s(const std::filesystem::path& file) {
  const auto table = CsvTable::load(file);
  return table.rows() == 0 ? 0.0 : table.column("time_s").back();
}

Check verdict_of(const char* name, const char* meaning, bool holds, const std::string& otherwise) {
  return holds ? passed(name, meaning) : failed(name, meaning, otherwise);
}

Check fired(bool happened, const char* otherwise) {
  auto check = passed("fault_fired", "the kernel refused a write, or ended the process");
  if (!happened) {
    check.verdict = Verdict::kInvalid;
    check.reason = otherwise;
  }
  return check;
}

Check written_before(const std::filesystem::path& folder, core::Nanoseconds struck_ns,
                     const CaseRecord& run) {
  constexpr auto kName = "record_kept";
  constexpr auto kMeaning = "what was written before can be read, to the last block";
  const double end_s = core::seconds(std::min(struck_ns, run.outcome.end_ns));
  const double last_s = last_time_s(folder / "log.csv");
  return verdict_of(kName, kMeaning, last_s >= end_s - kMostUnwritten_s,
                    fmt::format("log.csv ends at {:.4f} s, struck at {:.4f} s", last_s, end_s));
}

}  // namespace

std::vector<Check> judge_record(const std::filesystem::path& folder, const HostSchedule& host,
                                const CaseRecord& run, const RecordFacts& facts) {
  std::vector<Check> checks;
  if (!host.full_disks.empty()) {
    checks.push_back(fired(!facts.writes_succeeded, "every write of the record succeeded"));
    checks.push_back(written_before(folder, host.full_disks.front().from_ns, run));
    checks.push_back(verdict_of(
        "torn_record_is_no_pass", "a judge who knows nothing of the fault calls the run INVALID",
        facts.ordinary == Verdict::kInvalid, fmt::format("it says {}", name_of(facts.ordinary))));
  }
  if (host.killed_ns) {
    checks.push_back(fired(facts.host_was_killed, "the run ended before"));
    checks.push_back(written_before(folder, *host.killed_ns, run));
    const auto events = text_of(folder / kEventsFile);
    checks.push_back(verdict_of("plant_removes_drive",
                                "a plant whose controller is killed takes the drive away itself",
                                events.find("\"peer_lost\"") != std::string::npos &&
                                    events.find("\"drive_removed\"") != std::string::npos,
                                "events.jsonl does not say so"));
    const double plant_s = last_time_s(folder / "truth.csv");
    checks.push_back(
        verdict_of("truth_to_the_kill", "the plant's own record goes to the last exchange",
                   plant_s >= core::seconds(*host.killed_ns - 2 * run.outcome.exchange_ns),
                   fmt::format("truth.csv ends at {:.4f} s", plant_s)));
  }
  return checks;
}

Check recorded_run_check(const std::filesystem::path& folder, const CaseRecord& run,
                         bool log_may_be_short, bool truth_may_be_short) {
  Check check;
  check.name = "recorded_run_is_judged";
  check.meaning = "the record on disk is the run that was judged for faults";
  const auto truth = CsvTable::load(folder / "truth.csv");
  const auto log = CsvTable::load(folder / "log.csv");
  const auto fits = [](std::size_t rows, std::size_t expected, bool may_be_short) {
    return may_be_short ? rows <= expected : rows == expected;
  };
  bool same = fits(truth.rows(), run.truth.size(), truth_may_be_short) &&
              fits(log.rows(), run.log.size(), log_may_be_short);
  for (const auto axis : core::kAllAxes) {
    const auto column = truth.column(fmt::format("{}_carriage_m", core::name_of(axis)));
    const auto duty = log.column(fmt::format("{}_duty_pct", core::name_of(axis)));
    for (std::size_t i = 0; same && i < column.size(); ++i) {
      same = column[i] == run.truth[i].axes[axis].carriage_m;
    }
    for (std::size_t i = 0; same && i < duty.size(); ++i) {
      same = duty[i] == run.log[i].axes[axis].duty_pct;
    }
  }
  check.verdict = same ? Verdict::kPass : Verdict::kInvalid;
  check.reason = same ? "" : "truth.csv or log.csv differs from it";
  return check;
}

}  // namespace towbench::harness
