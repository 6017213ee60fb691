// Any text as a formula: understood, or refused with a place in it; what is understood can be read
// on a short trace.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "harness/requirements/run_signals.h"
#include "harness/signal_logic/robustness.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace towbench::harness;
  static const auto vocabulary = run_vocabulary({"whole", "steady"});
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto parsed = parse_formula(text, vocabulary);
  if (!parsed) {
    if (parsed.error().allowed.empty() || parsed.error().column > size + 1) {
      std::abort();
    }
    return 0;
  }
  Trace trace;
  trace.time_s = {0, 1e-3, 2.5e-3};
  trace.signals.assign(vocabulary.signals.size(), {1, -2, 3});
  trace.events = {{"kill_edge", {0.5e-3}}};
  trace.windows = {{"whole", {0, 1}}};
  if (robustness_of(parsed->formula, trace).over_time.size() != trace.samples()) {
    std::abort();
  }
  return 0;
}
