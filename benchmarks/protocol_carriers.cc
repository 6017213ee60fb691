// A lockstep turn over a real carrier against a bare ping-pong of as many bytes or frames on the
// same carrier, in alternating blocks of one run.
// usage: benchmark_protocol_carriers local | can:IF[,IF][@fd] | serial:DEVICE,DEVICE   [BLOCKS
// [TURNS]]
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include "protocol/carriers/connection.h"
#include "protocol/carriers/load.h"
#include "protocol/carriers/local_socket.h"
#include "protocol/carriers/lockstep_link.h"
#include "protocol/carriers/serial_port.h"

namespace towbench::protocol {
namespace {

using Clock = std::chrono::steady_clock;

// What the digest sends in one exchange of two axes.
constexpr std::size_t kFramesEachWay = 3;
constexpr std::size_t kBytesToPlant = 2 * (13 + 6) + 9 + 6;
constexpr std::size_t kBytesToController = 2 * (39 + 6) + 9 + 6;

struct Bare {
  ByteStream* stream = nullptr;
  SocketCan* bus = nullptr;

  bool send(std::size_t bytes, std::uint32_t id) const {
    if (bus != nullptr) {
      std::array<CanFrame, kFramesEachWay> frames;
      frames.fill(can_frame(id, 1));
      return bus->send(frames).has_value();
    }
    static const std::array<std::byte, 256> kBytes{};
    return stream->write(std::span(kBytes).first(bytes)).has_value();
  }
  bool receive(std::size_t bytes) const {
    std::array<CanFrame, 16> frames;
    std::array<std::byte, 256> into;
    std::size_t left = bus != nullptr ? kFramesEachWay : bytes;
    while (left > 0) {
      const auto some = bus != nullptr ? bus->receive(frames, core::kNanosecondsPerSecond)
                                       : stream->read_some(into, core::kNanosecondsPerSecond);
      if (!some || *some == 0) {
        return false;
      }
      left -= std::min(left, *some);
    }
    return true;
  }
};

// Answers as a plant does: a report of both axes, then Advanced.
class Answering final : public MessageSink {
 public:
  explicit Answering(MessageSink& controller) : controller_(controller) {}
  using MessageSink::on;
  void on(const Advance& advance) noexcept override {
    for (const auto axis : core::kPlanarAxes) {
      controller_.on(EncoderReport{.axis = axis,
                                   .time_ns = advance.until_ns,
                                   .count_change = 1,
                                   .last_edge_ns = advance.until_ns - 10,
                                   .capture_period_ns = 50'000,
                                   .sequence = sequence_});
    }
    ++sequence_;
    controller_.on(Advanced{advance.until_ns});
  }

 private:
  MessageSink& controller_;
  std::uint32_t sequence_ = 0;
};

struct End {
  std::unique_ptr<ByteStream> stream;
  std::unique_ptr<SocketCan> bus;
  std::unique_ptr<TurnLink> link;
};

End make_end(const CarrierAddress& address, CanDirection direction) {
  End end;
  if (address.scheme == Scheme::kCan) {
    const auto named = named_bus(address.place).value_or(NamedBus{.interface = address.place});
    auto bus = SocketCan::open(
        named.interface,
        direction == CanDirection::kToPlant ? CanDirection::kToController : CanDirection::kToPlant,
        named.is_fd);
    if (!bus) {
      std::fprintf(stderr, "%s\n", bus.error().message.c_str());
      std::exit(3);
    }
    end.bus = std::move(*bus);
    end.link = std::make_unique<CanLink>(*end.bus, direction);
  } else {
    auto port = SerialPort::open(address.place, address.baud);
    if (!port) {
      std::fprintf(stderr, "%s\n", port.error().message.c_str());
      std::exit(3);
    }
    end.stream = std::move(*port);
    end.link = std::make_unique<SerialLockstepLink>(*end.stream);
  }
  return end;
}

struct Blocks {
  unsigned count = 20;
  unsigned turns = 1000;
};

// Both sides run the same plan of blocks, bare first.
void serve(End& end, const Blocks& blocks) {
  const Bare bare{end.stream.get(), end.bus.get()};
  Answering plant(end.link->peer());
  for (unsigned block = 0; block < blocks.count; ++block) {
    for (unsigned turn = 0; turn < blocks.turns; ++turn) {
      if (!bare.receive(kBytesToPlant) || !bare.send(kBytesToController, can_id::kDigest)) {
        return;
      }
    }
    for (unsigned turn = 0; turn < blocks.turns; ++turn) {
      if (!end.link->wait(plant)) {
        return;
      }
    }
  }
}

double us_a_turn(Clock::time_point start, unsigned turns) {
  return std::chrono::duration<double, std::micro>(Clock::now() - start).count() / turns;
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

int measure(End& end, const Blocks& blocks, const char* name) {
  const Bare bare{end.stream.get(), end.bus.get()};
  std::vector<double> bare_us;
  std::vector<double> ours_us;
  class Ignore final : public MessageSink {
  } controller;
  core::Nanoseconds now_ns = 0;
  std::uint32_t sequence = 0;
  for (unsigned block = 0; block < blocks.count; ++block) {
    auto start = Clock::now();
    for (unsigned turn = 0; turn < blocks.turns; ++turn) {
      if (!bare.send(kBytesToPlant, can_id::kDuty) || !bare.receive(kBytesToController)) {
        std::fprintf(stderr, "the peer is lost\n");
        return 3;
      }
    }
    bare_us.push_back(us_a_turn(start, blocks.turns));
    start = Clock::now();
    for (unsigned turn = 0; turn < blocks.turns; ++turn) {
      now_ns += core::kNanosecondsPerMillisecond;
      for (const auto axis : core::kPlanarAxes) {
        end.link->peer().on(PwmDuty{
            .axis = axis, .channel_a_ticks = 7, .period_ticks = 1000, .sequence = sequence});
      }
      ++sequence;
      end.link->peer().on(Advance{now_ns});
      if (!end.link->wait_for(Turn::kAdvanced, controller)) {
        std::fprintf(stderr, "the peer is lost\n");
        return 3;
      }
    }
    ours_us.push_back(us_a_turn(start, blocks.turns));
  }
  std::printf(
      "%s: bare %.1f us, ours %.1f us, ratio of medians %.3f over %u alternating blocks of %u\n",
      name, median_of(bare_us), median_of(ours_us), median_of(ours_us) / median_of(bare_us),
      blocks.count, blocks.turns);
  return 0;
}

// What the wire must bear at worst, by the reckoning that refuses a run by the wall clock.
void tell_worst_case(const CarrierAddress& address) {
  const bool is_bus = address.scheme == Scheme::kCan;
  constexpr std::uint32_t kFastestClassicCan = 1'000'000;
  const auto named = named_bus(address.place);
  const auto rate = named && named->bit_per_s > 0 ? named->bit_per_s : kFastestClassicCan;
  const Load load = is_bus ? can_load({}, rate) : serial_load({.lockstep = true}, address.baud);
  std::printf(
      "worst case at 1 kHz, digest: %.0f kbit/s to the plant, %.0f to the controller, %.0f %% of "
      "%.0f "
      "bit/s\n",
      load.to_plant_bit_per_s * 1e-3, load.to_controller_bit_per_s * 1e-3, 100 * load.fraction(),
      load.capacity_bit_per_s);
}

int run(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "local";
  Blocks blocks;
  blocks.count = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : blocks.count;
  blocks.turns = argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : blocks.turns;
  // Both on one processor: what the carrier costs, not what a wake-up of another processor does.
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(0, &set);
  ::sched_setaffinity(0, sizeof(set), &set);
  End near;
  End far;
  if (name == "local") {
    auto pair = LocalSocket::pair();
    near.stream = std::move(pair->first);
    far.stream = std::move(pair->second);
    near.link = std::make_unique<LockstepLink>(*near.stream);
    far.link = std::make_unique<LockstepLink>(*far.stream);
  } else {
    const auto ends = parse_carrier_ends(name);
    if (!ends) {
      std::fprintf(stderr, "%s\n", ends.error().message.c_str());
      return 2;
    }
    near = make_end(ends->controller, CanDirection::kToPlant);
    far = make_end(ends->plant, CanDirection::kToController);
    tell_worst_case(ends->controller);
  }
  const pid_t child = ::fork();
  if (child == 0) {
    serve(far, blocks);
    std::_Exit(0);
  }
  const int code = measure(near, blocks, name.c_str());
  near = {};
  ::waitpid(child, nullptr, 0);
  return code;
}

}  // namespace
}  // namespace towbench::protocol

int main(int argc, char** argv) {
  return towbench::protocol::run(argc, argv);
}
