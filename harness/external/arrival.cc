#include "harness/external/arrival.h"

#include <fmt/format.h>

namespace towbench::harness {
namespace {

constexpr auto kSomebodyComes = std::chrono::seconds(60);
constexpr std::string_view kPlaceholder = "{address}";

}  // namespace

std::string with_address(std::string command, const std::string& address) {
  for (auto at = command.find(kPlaceholder); at != std::string::npos;
       at = command.find(kPlaceholder, at + address.size())) {
    command.replace(at, kPlaceholder.size(), address);
  }
  return command;
}

Arrival::Arrival(const ExternalController& controller, std::filesystem::path printed,
                 const LoopWatchers& watchers)
    : controller_(controller), printed_(std::move(printed)), watchers_(watchers) {
  if (controller.address) {
    address_ = *controller.address;
    deadline_ = Clock::now() + kSomebodyComes;
  } else {
    address_.place = (socket_.path() / "bench").string();
    deadline_ = Clock::now() + kProcessComes;
  }
}

std::string Arrival::await() {
  const auto keep_waiting = [this] { return goes_on(); };
  auto opened = protocol::Connection::to_controller(address_, keep_waiting);
  if (!opened) {
    return opened.error().message;
  }
  if (*opened == nullptr) {
    return nobody_came();
  }
  connection_ = std::move(*opened);
  const auto hello = connection_->await_hello(keep_waiting);
  if (!hello) {
    return nobody_came();
  }
  hello_ = *hello;
  return {};
}

std::string Arrival::join() {
  connection_.reset();
  const auto how = process_ ? process_->join() : std::string{};
  return how.empty() ? how : "the controller's process " + how;
}

bool Arrival::goes_on() {
  if (!told_ && watchers_.waiting && controller_.address) {
    watchers_.waiting(address_.text());
  }
  told_ = true;
  if (!controller_.address && !process_) {
    process_.emplace(with_address(controller_.command, address_.text()), printed_);
  }
  const bool stopped = watchers_.stop != nullptr && watchers_.stop->load();
  return !stopped && Clock::now() < deadline_ && (!process_ || process_->runs());
}

std::string Arrival::nobody_came() {
  if (process_ && !process_->runs()) {
    const auto how = process_->join();
    return fmt::format("the controller's process {} before it greeted{}; see {}",
                       how.empty() ? "ended" : how, note_of_missing_address(), printed_.string());
  }
  return fmt::format("no controller greeted at {}{}", address_.text(), note_of_missing_address());
}

// A command without the placeholder is the usual mistake.
std::string Arrival::note_of_missing_address() const {
  const bool told =
      controller_.address || controller_.command.find(kPlaceholder) != std::string::npos;
  return told ? "" : fmt::format(" (its command has no {} to tell it where)", kPlaceholder);
}

}  // namespace towbench::harness
