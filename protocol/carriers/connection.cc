#include "protocol/carriers/connection.h"

#include <chrono>
#include <optional>

#include "protocol/carriers/local_socket.h"
#include "protocol/carriers/lockstep_link.h"
#include "protocol/carriers/serial_port.h"

namespace towbench::protocol {
namespace {

using Clock = std::chrono::steady_clock;

constexpr core::Nanoseconds kBetweenHeartbeats_ns = 100 * core::kNanosecondsPerMillisecond;

struct HeartbeatWatch final : MessageSink {
  using MessageSink::on;
  void on(const Heartbeat& /*heartbeat*/) noexcept override { heard = true; }
  bool heard = false;
};

struct HelloWatch final : MessageSink {
  using MessageSink::on;
  void on(const Hello& message) noexcept override { hello = message; }
  std::optional<Hello> hello;
};

using Opened = CarrierResult<std::unique_ptr<Connection>>;

}  // namespace

Opened Connection::to_plant(const CarrierAddress& address, core::Nanoseconds patience_ns) {
  Opened opened;
  if (address.scheme != Scheme::kLocal) {
    opened = open_port(address, CanDirection::kToPlant);
  } else if (auto socket = LocalSocket::connect(address.place, patience_ns); socket) {
    opened = over(std::move(*socket));
  } else {
    opened = tl::unexpected<CarrierError>(socket.error());
  }
  if (opened) {
    if (const auto heard = (*opened)->await_heartbeat(patience_ns); !heard) {
      return carrier_failure(heard.error(), address.text() + ": no emulator waits there");
    }
  }
  return opened;
}

Opened Connection::to_controller(const CarrierAddress& address, const KeepWaiting& keep_waiting) {
  if (address.scheme != Scheme::kLocal) {
    return open_port(address, CanDirection::kToController);
  }
  auto server = LocalServer::listen(address.place);
  if (!server) {
    return tl::unexpected<CarrierError>(server.error());
  }
  while (keep_waiting()) {
    if (auto socket = (*server)->accept(kBetweenHeartbeats_ns)) {
      return over(std::move(*socket));
    } else if (socket.error().code != core::ErrorCode::kPeerSilent) {
      return tl::unexpected<CarrierError>(socket.error());
    }
  }
  return nullptr;
}

std::unique_ptr<Connection> Connection::over(std::unique_ptr<ByteStream> stream) {
  std::unique_ptr<Connection> connection(new Connection);
  connection->is_local_ = true;
  connection->stream_ = std::move(stream);
  connection->make_link();
  return connection;
}

Opened Connection::open_port(const CarrierAddress& address, CanDirection direction) {
  std::unique_ptr<Connection> connection(new Connection);
  connection->direction_ = direction;
  if (address.scheme == Scheme::kSerial) {
    auto port = SerialPort::open(address.place, address.baud);
    if (!port) {
      return tl::unexpected<CarrierError>(port.error());
    }
    connection->stream_ = std::move(*port);
  } else {
    const auto named = named_bus(address.place).value_or(NamedBus{.interface = address.place});
    auto bus = SocketCan::open(
        named.interface,
        direction == CanDirection::kToPlant ? CanDirection::kToController : CanDirection::kToPlant,
        named.is_fd);
    if (!bus) {
      return tl::unexpected<CarrierError>(bus.error());
    }
    connection->bus_ = std::move(*bus);
    if (named.bit_per_s > 0 && !is_virtual_can(named.interface)) {
      return carrier_failure(core::ErrorCode::kTransportFailed,
                             address.text() +
                                 ": a real interface has a rate of its own (ip link: "
                                 "bitrate)");
    }
    if (named.bit_per_s > 0) {
      connection->paced_bus_ = std::make_unique<PacedCan>(
          *connection->bus_, connection->wire_clock_, named.bit_per_s, named.data_bit_per_s);
    }
  }
  connection->make_link();
  return connection;
}

void Connection::make_link() {
  if (bus_ != nullptr) {
    CanPort& port = paced_bus_ ? static_cast<CanPort&>(*paced_bus_) : *bus_;
    auto link = std::make_unique<CanLink>(port, direction_);
    can_link_ = link.get();
    link_ = std::move(link);
  } else if (is_local_) {
    link_ = std::make_unique<LockstepLink>(*stream_);
  } else {
    link_ = std::make_unique<SerialLockstepLink>(*stream_);
  }
}

WireUse Connection::wire_use() const noexcept {
  const auto bits = [](const auto& link, std::uint64_t bits_a_byte) {
    return WireUse{link.bytes_sent() * bits_a_byte, link.bytes_received() * bits_a_byte};
  };
  if (can_link_ != nullptr) {
    return {can_link_->bits_sent(), can_link_->bits_received()};
  }
  constexpr std::uint64_t kBitsAByte = 8;
  return is_local_ ? bits(static_cast<const LockstepLink&>(*link_), kBitsAByte)
                   : bits(static_cast<const SerialLockstepLink&>(*link_), kBitsPerSerialByte);
}

core::Status Connection::await_heartbeat(core::Nanoseconds patience_ns) {
  HeartbeatWatch watch;
  const auto deadline = Clock::now() + std::chrono::nanoseconds(patience_ns);
  while (!watch.heard) {
    if (Clock::now() > deadline) {
      return core::failure(core::ErrorCode::kPeerSilent);
    }
    if (const auto heard = link_->listen(watch, kBetweenHeartbeats_ns); !heard) {
      return core::failure(heard.error());
    }
  }
  return {};
}

core::Result<Hello> Connection::await_hello(const KeepWaiting& keep_waiting) {
  HelloWatch watch;
  Heartbeat heartbeat;
  while (!watch.hello) {
    if (!keep_waiting()) {
      return core::failure(core::ErrorCode::kPeerSilent);
    }
    link_->peer().on(heartbeat);
    ++heartbeat.sequence;
    const auto heard = link_->listen(watch, kBetweenHeartbeats_ns);
    if (!heard && heard.error() == core::ErrorCode::kPeerSilent) {
      make_link();  // nobody took the heartbeats off the line: nothing is lost
    } else if (!heard) {
      return core::failure(heard.error());
    }
  }
  return *watch.hello;
}

}  // namespace towbench::protocol
