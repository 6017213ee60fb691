#include "harness/commands/serial_console.h"

#include <array>
#include <chrono>
#include <stdexcept>

namespace towbench::harness {
namespace {

constexpr std::size_t kMostWaiting = 65'536;
constexpr core::Nanoseconds kPause_ns = 10 * core::kNanosecondsPerMillisecond;
constexpr auto kUntilNextTry = std::chrono::milliseconds(500);
constexpr char kEndOfTransmission = 4;  // Ctrl-D

}  // namespace

SerialConsole::SerialConsole(const protocol::CarrierAddress& address) : address_(address) {
  auto port = protocol::SerialPort::open(address_.place, address_.baud);
  if (!port) {
    throw std::runtime_error(port.error().message);
  }
  port_ = std::move(*port);
  thread_ = std::thread([this] { serve(); });
}

SerialConsole::~SerialConsole() {
  is_over_ = true;
  thread_.join();
}

void SerialConsole::feed(bbmc::ControllerNode& controller) {
  {
    const std::lock_guard lock(mutex_);
    buffer_ += typed_;
    typed_.clear();
  }
  const auto end = buffer_.find(kEndOfTransmission);
  ended_ = ended_ || end != std::string::npos;
  buffer_.erase(0, controller.type(std::string_view(buffer_).substr(0, end)));
}

void SerialConsole::print(std::string_view text) {
  const std::lock_guard lock(mutex_);
  to_show_ += text;
  if (to_show_.size() > kMostWaiting) {
    to_show_.erase(0, to_show_.size() - kMostWaiting);
  }
}

void SerialConsole::serve() {
  while (!is_over_) {
    if (port_ != nullptr && !exchange()) {
      port_.reset();
    }
    if (port_ == nullptr) {
      std::this_thread::sleep_for(kUntilNextTry);
      auto port = protocol::SerialPort::open(address_.place, address_.baud);
      port_ = port ? std::move(*port) : nullptr;
    }
  }
  if (port_ != nullptr) {
    (void)exchange();
  }
}

bool SerialConsole::exchange() {
  std::string showing;
  {
    const std::lock_guard lock(mutex_);
    showing.swap(to_show_);
  }
  const auto shown = port_->write(std::as_bytes(std::span(showing)));
  if (!shown && shown.error() != core::ErrorCode::kPeerSilent) {
    return false;
  }
  std::array<std::byte, 256> bytes{};
  const auto count = port_->read_some(bytes, kPause_ns);
  if (!count) {
    return false;
  }
  const std::lock_guard lock(mutex_);
  for (const std::byte byte : std::span(bytes).first(*count)) {
    typed_ += static_cast<char>(byte);
  }
  return true;
}

}  // namespace towbench::harness
