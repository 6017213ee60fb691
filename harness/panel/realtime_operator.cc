#include "harness/panel/realtime_operator.h"

#include <utility>

#include "harness/fixtures/fixture_error.h"

namespace towbench::harness {
namespace {

[[noreturn]] void refuse(const char* what) {
  throw FixtureError({.file = "panel"}, std::string(what) + " in a run by the wall clock",
                     "typing, finishing and cutting short; lockstep bears all");
}

}  // namespace

RealtimeOperator::RealtimeOperator(std::vector<OperatorAct> before, bool holds)
    : holds_(holds), done_(std::move(before)) {
  done_.reserve(done_.size() + kMostActs);  // not while the clock runs
}

void RealtimeOperator::type(std::string bytes) {
  const auto pieces = (bytes.size() + Keys().bytes.size() - 1) / Keys().bytes.size();
  if (pieces > decltype(keys_)::capacity() - keys_.size()) {
    throw FixtureError({.file = "panel"}, "so much typed at once", "what the console can follow");
  }
  for (std::string_view rest = bytes; !rest.empty();) {
    Keys keys;
    keys.size = static_cast<std::uint8_t>(rest.copy(keys.bytes.data(), keys.bytes.size()));
    rest.remove_prefix(keys.size);
    (void)keys_.push(keys);  // there is room, and nobody else gives
  }
}

void RealtimeOperator::finish() {
  Keys keys{.kind = OperatorAct::Kind::kFinished};
  keys.size = static_cast<std::uint8_t>(std::string_view("finish").copy(keys.bytes.data(), 6));
  (void)keys_.push(keys);  // full: pressed again
}

std::span<const OperatorAct> RealtimeOperator::at(core::Nanoseconds now_ns,
                                                  SteeredBench& /*bench*/) {
  Keys keys;
  while (done_.size() < done_.capacity() && keys_.pop(keys)) {
    done_.push_back({.time_ns = now_ns, .kind = keys.kind, .text = std::string(keys.text())});
  }
  const auto fresh = std::span<const OperatorAct>(done_).subspan(told_);
  told_ = done_.size();
  return fresh;
}

void RealtimeOperator::inject_now(Fault /*fault*/) {
  refuse("breaking something");
}
void RealtimeOperator::clear(const FaultPlace& /*place*/, FaultKind /*kind*/) {
  refuse("clearing a fault");
}
void RealtimeOperator::set_speed(double /*speed*/) {
  refuse("another speed");
}
void RealtimeOperator::pause(bool /*paused*/) {
  refuse("a pause");
}
void RealtimeOperator::step(core::Nanoseconds /*length_ns*/) {
  refuse("a single step");
}

}  // namespace towbench::harness
