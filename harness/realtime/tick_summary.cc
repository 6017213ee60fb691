#include "harness/realtime/tick_summary.h"

#include <fmt/format.h>

namespace towbench::harness {
namespace {

using nlohmann::json;

DurationFigures figures_from(const json& object) {
  DurationFigures figures;
  object.at("min_ns").get_to(figures.min_ns);
  object.at("mean_ns").get_to(figures.mean_ns);
  object.at("p50_ns").get_to(figures.p50_ns);
  object.at("p99_ns").get_to(figures.p99_ns);
  object.at("p999_ns").get_to(figures.p999_ns);
  object.at("max_ns").get_to(figures.max_ns);
  object.at("max_at").get_to(figures.max_at);
  return figures;
}

double us(core::Nanoseconds duration_ns) {
  return static_cast<double>(duration_ns) / static_cast<double>(core::kNanosecondsPerMicrosecond);
}

std::string line(const char* what, const DurationFigures& figures) {
  return fmt::format(
      "  {:<9} min {:7.1f}  mean {:7.1f}  p50 {:7.1f}  p99 {:7.1f}  p99.9 {:7.1f}  max {:8.1f} us "
      "at tick {}\n",
      what, us(figures.min_ns), us(figures.mean_ns), us(figures.p50_ns), us(figures.p99_ns),
      us(figures.p999_ns), us(figures.max_ns), figures.max_at);
}

}  // namespace

json to_json(const DurationFigures& figures) {
  return {{"min_ns", figures.min_ns}, {"mean_ns", figures.mean_ns}, {"p50_ns", figures.p50_ns},
          {"p99_ns", figures.p99_ns}, {"p999_ns", figures.p999_ns}, {"max_ns", figures.max_ns},
          {"max_at", figures.max_at}};
}

DurationFigures figures_of(const DurationHistogram& histogram) {
  return {.min_ns = histogram.min_ns(),
          .mean_ns = histogram.mean_ns(),
          .p50_ns = histogram.percentile_ns(0.5),
          .p99_ns = histogram.percentile_ns(0.99),
          .p999_ns = histogram.percentile_ns(0.999),
          .max_ns = histogram.max_ns(),
          .max_at = histogram.max_at()};
}

TickSummary summarise(std::string side, std::string rights, const TickPolicy& policy,
                      const TickRecord& record) {
  return {.side = std::move(side),
          .rights = std::move(rights),
          .period_ns = policy.period_ns,
          .ticks = record.lateness.count(),
          .overruns = record.overruns,
          .most_behind = record.most_behind,
          .worst_tick = record.worst_tick,
          .max_behind = policy.max_behind,
          .host_was_late = record.host_was_late,
          .lateness = figures_of(record.lateness),
          .execution = figures_of(record.execution)};
}

json to_json(const TickSummary& summary) {
  return {{"side", summary.side},
          {"rights", summary.rights},
          {"period_ns", summary.period_ns},
          {"ticks", summary.ticks},
          {"overruns", summary.overruns},
          {"most_behind", summary.most_behind},
          {"worst_tick", summary.worst_tick},
          {"max_behind", summary.max_behind},
          {"host_was_late", summary.host_was_late},
          {"lateness", to_json(summary.lateness)},
          {"execution", to_json(summary.execution)}};
}

json to_json(const TickSummary& summary, const TickRecord& record) {
  auto object = to_json(summary);
  object["lateness_us_ticks"] = bins_of(record.lateness);
  object["execution_us_ticks"] = bins_of(record.execution);
  return object;
}

TickSummary tick_summary_from(const json& object) {
  TickSummary summary;
  object.at("side").get_to(summary.side);
  object.at("rights").get_to(summary.rights);
  object.at("period_ns").get_to(summary.period_ns);
  object.at("ticks").get_to(summary.ticks);
  object.at("overruns").get_to(summary.overruns);
  object.at("most_behind").get_to(summary.most_behind);
  object.at("worst_tick").get_to(summary.worst_tick);
  object.at("max_behind").get_to(summary.max_behind);
  object.at("host_was_late").get_to(summary.host_was_late);
  summary.lateness = figures_from(object.at("lateness"));
  summary.execution = figures_from(object.at("execution"));
  return summary;
}

json bins_of(const DurationHistogram& histogram) {
  json bins = json::array();
  for (std::size_t bin = 0; bin <= DurationHistogram::kBins; ++bin) {
    if (histogram.in_bin(bin) > 0) {
      bins.push_back({bin, histogram.in_bin(bin)});
    }
  }
  return bins;
}

std::string text_of(const TickSummary& summary) {
  return fmt::format("{}: {} ticks of {:.0f} us, {} overruns, at most {} behind; {}\n",
                     summary.side, summary.ticks, us(summary.period_ns), summary.overruns,
                     summary.most_behind, summary.rights) +
         line("lateness", summary.lateness) + line("execution", summary.execution);
}

}  // namespace towbench::harness
