#include "harness/experiment/board_plan_text.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "harness/fixtures/canonical_hash.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/fixtures/toml_number.h"

namespace towbench::harness {
namespace {

using Kind = BoardFault::Kind;

constexpr double kLongestTime_s = 86'400.0;
constexpr std::array<std::string_view, 4> kKinds{"brown_out", "stuck_bit", "lost_interrupt",
                                                 "delayed_interrupt"};
constexpr std::array<std::string_view, 2> kMetrics{"worst_instructions", "stack_bytes"};
constexpr double kDark_s = 0.05;  // of a brown-out that says nothing else

// Which keys mean something for a kind, besides `do` and `at_s`.
std::vector<std::string_view> keys_of(Kind kind) {
  switch (kind) {
    case Kind::kBrownOut:
      return {"for_s"};
    case Kind::kStuckBit:
      return {"for_s", "address", "bit", "high"};
    case Kind::kLostInterrupt:
      return {"interrupt", "count"};
    case Kind::kDelayedInterrupt:
      break;
  }
  return {"for_s", "interrupt", "delay_s"};
}

void refuse_idle_keys(const TableReader& reader, Kind kind) {
  const auto meant = keys_of(kind);
  for (const char* key : {"for_s", "address", "bit", "high", "interrupt", "count", "delay_s"}) {
    const bool means = std::find(meant.begin(), meant.end(), key) != meant.end();
    if (reader.has(key) && !means) {
      throw FixtureError(reader.place_of(key), "a key without effect",
                         fmt::format("{}", fmt::join(meant, ", ")));
    }
  }
}

// "2s", "50ms", "1us" as seconds, anything else as it stands.
std::string in_seconds(std::string_view text) {
  double value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view unit(end.ptr,
                              static_cast<std::size_t>(text.data() + text.size() - end.ptr));
  const double factor = unit == "s" ? 1.0 : unit == "ms" ? 1e-3 : unit == "us" ? 1e-6 : 0.0;
  return end.ec == std::errc() && factor > 0 ? toml_number(value * factor) : std::string(text);
}

}  // namespace

BoardFault read_board_fault(TableReader& reader) {
  BoardFault fault;
  std::size_t kind = 0;
  reader.choice("do", kind, {kKinds.begin(), kKinds.end()});
  fault.kind = static_cast<Kind>(kind);
  reader.value("at_s", fault.at_s, core::between(0, kLongestTime_s), "when it begins");
  double for_s = kDark_s;
  reader.value("for_s", for_s, core::between(1e-4, kLongestTime_s), "how long it lasts");
  if (reader.has("for_s") || fault.kind == Kind::kBrownOut) {
    fault.for_s = for_s;
  }
  reader.value("address", fault.address, core::between(0x4400'0000, 0x4FFF'FFFC),
               "register of a peripheral");
  reader.value("bit", fault.bit, core::between(0, 31), "which bit of it");
  reader.value("high", fault.high, core::any_finite(), "where it sticks");
  reader.value("interrupt", fault.interrupt, core::between(0, 127), "input of the AINTC");
  reader.value("count", fault.count, core::between(1, 1e6), "how many are lost");
  reader.value("delay_s", fault.delay_s, core::between(1e-6, 10), "how late each comes");
  for (const char* key : {"do", "at_s"}) {
    reader.require(key);
  }
  if (fault.kind == Kind::kStuckBit) {
    reader.require("address");
    reader.require("bit");
  } else if (fault.kind != Kind::kBrownOut) {
    reader.require("interrupt");
  }
  reader.finish();
  refuse_idle_keys(reader, fault.kind);
  if (fault.address % 4 != 0) {
    throw FixtureError(reader.place_of("address"), fmt::format("0x{:x}", fault.address),
                       "a multiple of 4");
  }
  return fault;
}

BoardBudget read_board_budget(TableReader& reader) {
  BoardBudget budget;
  std::size_t metric = 0;
  reader.choice("metric", metric, {kMetrics.begin(), kMetrics.end()});
  budget.metric = static_cast<BoardBudget::Metric>(metric);
  reader.value("interrupt", budget.interrupt, core::between(0, 127), "input of the AINTC");
  reader.value("max", budget.max, core::between(0, 1e12), "largest value allowed");
  reader.text("source", budget.source, "where the figure comes from");
  reader.require("metric");
  reader.require("max");
  if (budget.metric == BoardBudget::Metric::kWorstInstructions) {
    reader.require("interrupt");
  } else if (reader.has("interrupt")) {
    throw FixtureError(reader.place_of("interrupt"), "a key without effect",
                       "only with worst_instructions");
  }
  reader.finish();
  return budget;
}

std::string to_toml(const BoardFault& fault) {
  auto text = fmt::format("\n[[board_fault]]\ndo = \"{}\"\nat_s = {}\n",
                          kKinds[static_cast<std::size_t>(fault.kind)], toml_number(fault.at_s));
  text += fault.for_s ? "for_s = " + toml_number(*fault.for_s) + '\n' : "";
  switch (fault.kind) {
    case Kind::kBrownOut:
      break;
    case Kind::kStuckBit:
      text += fmt::format("address = 0x{:08X}\nbit = {}\nhigh = {}\n", fault.address, fault.bit,
                          fault.high);
      break;
    case Kind::kLostInterrupt:
      text += fmt::format("interrupt = {}\ncount = {}\n", fault.interrupt, fault.count);
      break;
    case Kind::kDelayedInterrupt:
      text += fmt::format("interrupt = {}\ndelay_s = {}\n", fault.interrupt,
                          toml_number(fault.delay_s));
      break;
  }
  return text;
}

std::string to_toml(const BoardBudget& budget) {
  auto text =
      fmt::format("\n[[board_budget]]\nmetric = \"{}\"\nmax = {}\n",
                  kMetrics[static_cast<std::size_t>(budget.metric)], toml_number(budget.max));
  if (budget.metric == BoardBudget::Metric::kWorstInstructions) {
    text += fmt::format("interrupt = {}\n", budget.interrupt);
  }
  return text + (budget.source.empty() ? "" : fmt::format("source = \"{}\"\n", budget.source));
}

std::string describe(const BoardFault& fault) {
  auto text =
      fmt::format("board {} at={}s", kKinds[static_cast<std::size_t>(fault.kind)], fault.at_s);
  text += fault.for_s ? fmt::format(" for={}s", *fault.for_s) : "";
  switch (fault.kind) {
    case Kind::kBrownOut:
      return text;
    case Kind::kStuckBit:
      return text +
             fmt::format(" address=0x{:08X} bit={} high={}", fault.address, fault.bit, fault.high);
    case Kind::kLostInterrupt:
      return text + fmt::format(" interrupt={} count={}", fault.interrupt, fault.count);
    case Kind::kDelayedInterrupt:
      break;
  }
  return text + fmt::format(" interrupt={} delay={}s", fault.interrupt, fault.delay_s);
}

bool is_board_fault(std::string_view words) noexcept {
  return words == "board" || words.starts_with("board ");
}

// The words become the table that they stand for: one set of rules for both.
BoardFault parse_board_fault(std::string_view words) {
  std::string toml = "schema = 1\n[[board_fault]]\n";
  std::string_view rest = words.substr(std::string_view("board").size());
  bool first = true;
  while (true) {
    const auto start = rest.find_first_not_of(' ');
    if (start == std::string_view::npos) {
      break;
    }
    const auto end = std::min(rest.find(' ', start), rest.size());
    const auto word = rest.substr(start, end - start);
    rest = rest.substr(end);
    const auto equals = word.find('=');
    const bool is_plain =
        word.find_first_not_of(
            "abcdefghijklmnopqrstuvwxyz"
            "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_=.+-") == std::string_view::npos;
    if (!is_plain || first != (equals == std::string_view::npos)) {
      throw FixtureError({.file = "--fault"}, fmt::format("\"{}\"", is_plain ? word : "?"),
                         "board KIND key=value ...");
    }
    if (first) {
      toml += fmt::format("do = \"{}\"\n", word);
      first = false;
      continue;
    }
    const auto key = word.substr(0, equals);
    const bool is_time = key == "at" || key == "for" || key == "delay";
    toml +=
        fmt::format("{}{} = {}\n", key, is_time ? "_s" : "", in_seconds(word.substr(equals + 1)));
  }
  const auto file = FixtureFile::parse(toml, fmt::format("--fault \"{}\"", words));
  TableReader whole(file, file.table());
  whole.permit("schema");
  auto tables = whole.tables("board_fault");
  return read_board_fault(tables.front());
}

void add_board_fault(ExperimentFixture& fixture, const BoardFault& fault) {
  fixture.experiment.board.faults.push_back(fault);
  fixture.experiment.budgets_apply = false;
  auto& text = fixture.sources.front().text;
  text += to_toml(fault);
  text += kBudgetsDoNotApply;
  CanonicalHash hash;
  hash.add(text);
  fixture.hash = hash.value();
}

}  // namespace towbench::harness
