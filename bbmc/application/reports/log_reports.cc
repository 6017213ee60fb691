#include "bbmc/application/reports/report.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

// The columns of BBMC 0.5's log: status, count, speed, q, q', u, with a time in front.
void write_row(std::size_t index, const DataLogRow& row, core::Axis axis,
               TextWriter& out) noexcept {
  const DataLogAxis& state = row.axes[axis];
  out.integer(static_cast<std::int64_t>(index)).text(",");
  out.fixed(core::seconds(row.time_ns), 6).text(",");
  out.integer(static_cast<std::int64_t>(state.mode)).text(",");
  out.integer(state.count).text(",");
  out.fixed(static_cast<double>(state.speed_count_per_s), 3).text(",");
  out.fixed(state.reference_count, 4).text(",");
  out.fixed(static_cast<double>(state.reference_speed_count_per_s), 3).text(",");
  out.fixed(static_cast<double>(state.duty_pct), 2).end_line();
}

void write_statistics(std::string_view name, const PerfLog::Statistics& statistics,
                      TextWriter& out) noexcept {
  out.text(name).text(": samples ").integer(static_cast<std::int64_t>(statistics.samples));
  out.text(", min ").integer(statistics.min_ns).text("ns, mean ").fixed(statistics.mean_ns(), 1);
  out.text("ns, max ").integer(statistics.max_ns).text("ns").end_line();
}

// One line for each bucket that holds something.
void write_bucket(std::size_t bucket, const PerfLog::Statistics& statistics,
                  TextWriter& out) noexcept {
  if (statistics.histogram[bucket] == 0) {
    return;
  }
  out.text("  below ").integer(std::int64_t{1} << bucket).text("us: ");
  out.integer(static_cast<std::int64_t>(statistics.histogram[bucket])).end_line();
}

}  // namespace

bool DataLogReport::next(SystemManager& system, TextWriter& out) noexcept {
  while (axis_ < kAxisCount && !wanted_[kAxes[axis_]]) {
    ++axis_;
  }
  if (axis_ == kAxisCount) {
    return false;
  }
  const core::Axis axis = kAxes[axis_];
  const auto rows = system.data_log().rows();
  if (stage_ == Stage::kHeader) {
    out.text("DATALOG_BEGIN: ").text(core::name_of(axis)).end_line();
    out.text("index,time_s,status,count,speed_count_per_s,reference_count,");
    out.text("reference_speed_count_per_s,duty_pct").end_line();
    stage_ = Stage::kRows;
    row_ = 0;
    return true;
  }
  if (row_ < rows.size()) {
    write_row(row_, rows[row_], axis, out);
    ++row_;
    return true;
  }
  out.text("DATALOG_END").end_line();
  stage_ = Stage::kHeader;
  ++axis_;
  return true;
}

bool PerfLogReport::next(SystemManager& system, TextWriter& out) noexcept {
  constexpr std::size_t kPartsEach = PerfLog::kBuckets + 1;
  if (part_ == 2 * kPartsEach) {
    return false;
  }
  const bool lateness = part_ < kPartsEach;
  const PerfLog& log = system.perf_log();
  const PerfLog::Statistics& statistics = lateness ? log.lateness() : log.execution();
  const std::size_t within = part_ % kPartsEach;
  if (within == 0) {
    write_statistics(lateness ? "lateness" : "execution", statistics, out);
  } else {
    write_bucket(within - 1, statistics, out);
  }
  ++part_;
  return true;
}

}  // namespace towbench::bbmc
