#include "harness/link/link_faults.h"

#include <algorithm>
#include <array>
#include <memory>

#include "harness/link/uart_line.h"
#include "protocol/frame.h"

namespace towbench::harness {
namespace {

// Messages of one kind and, where they have one, of one axis: those that are numbered together.
bool same_stream(const LinkMessage& a, const LinkMessage& b) {
  const auto axis_of = [](const LinkMessage& message) {
    return std::visit(
        [](const auto& each) -> int {
          if constexpr (requires { each.axis; }) {
            return static_cast<int>(each.axis);
          }
          return -1;
        },
        message);
  };
  return a.index() == b.index() && axis_of(a) == axis_of(b);
}

}  // namespace

LinkDisturber::LinkDisturber(const std::vector<LinkFault>& faults, bool to_plant)
    : to_plant_(to_plant) {
  for (const auto& fault : faults) {
    add(fault);
  }
}

void LinkDisturber::add(const LinkFault& fault) {
  if (fault.to_plant == to_plant_) {
    faults_.push_back({.fault = fault, .random = core::Random(fault.seed)});
    if (fault.kind == FaultKind::kBaudMismatch) {
      faults_.back().reader = std::make_unique<protocol::CobsReader>();
    }
  }
}

void LinkDisturber::arrive(const LinkMessage& message) {
  std::visit([&](const auto& each) { to_->on(each); }, message);
}

void LinkDisturber::carry(const LinkMessage& message, core::Nanoseconds now_ns) {
  carry_from(0, message, now_ns);
}

void LinkDisturber::carry_from(std::size_t index, const LinkMessage& message,
                               core::Nanoseconds now_ns) {
  for (; index < faults_.size(); ++index) {
    Acting& acting = faults_[index];
    const LinkFault& fault = acting.fault;
    const bool held_back = fault.kind == FaultKind::kReorder && acting.held.has_value();
    if (!fault.acts_at(now_ns) && !held_back) {
      continue;
    }
    switch (fault.kind) {
      case FaultKind::kLoss:
        if (acting.random.uniform() < fault.amount) {
          return;
        }
        break;
      case FaultKind::kDuplicate:
        if (acting.random.uniform() < fault.amount) {
          carry_from(index + 1, message, now_ns);
        }
        break;
      case FaultKind::kCorruptByte:
        if (acting.random.uniform() < fault.amount) {
          corrupt(acting, message);
          return;
        }
        break;
      case FaultKind::kBaudMismatch: {
        std::array<std::byte, protocol::CobsFraming::kMaxFrameSize> frame;
        const auto size = std::visit(
            [&](const auto& each) { return protocol::CobsFraming::append(each, frame); }, message);
        misread(acting, std::span(frame).first(size));
        return;
      }
      case FaultKind::kReorder:
        reorder(index, message, now_ns);
        return;
      case FaultKind::kDelay:
      case FaultKind::kJitter: {
        const double share = fault.kind == FaultKind::kJitter ? acting.random.uniform() : 1.0;
        acting.last_due_ns =
            std::max(acting.last_due_ns, now_ns + core::nanoseconds(share * fault.amount));
        waiting_.push_back({acting.last_due_ns, message});
        return;
      }
      default:
        break;
    }
  }
  // Behind what still waits: a link that only delays keeps the order.
  if (waiting_.empty()) {
    arrive(message);
  } else {
    waiting_.push_back({now_ns, message});
  }
}

void LinkDisturber::reorder(std::size_t index, const LinkMessage& message,
                            core::Nanoseconds now_ns) {
  Acting& acting = faults_[index];
  if (acting.held && same_stream(*acting.held, message)) {
    const LinkMessage late = *acting.held;
    acting.held.reset();
    carry_from(index + 1, message, now_ns);
    carry_from(index + 1, late, now_ns);
    return;
  }
  if (!acting.held && acting.random.uniform() < acting.fault.amount) {
    acting.held = message;
    return;
  }
  carry_from(index + 1, message, now_ns);
}

void LinkDisturber::corrupt(Acting& acting, const LinkMessage& message) {
  std::array<std::byte, protocol::LengthFraming::kMaxFrameSize> frame{};
  const std::size_t size = std::visit(
      [&](const auto& each) { return protocol::LengthFraming::append(each, frame); }, message);
  const auto bit =
      static_cast<std::size_t>(acting.random.bits() % (8 * std::max<std::size_t>(size, 1)));
  frame[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
  // On the heap: a reader holds two frames.
  const auto reader = std::make_unique<protocol::FrameReader>();
  reader->feed(std::span(frame).first(size), *to_);
  reader->finish(*to_);
}

LinkDisturber::Acting* LinkDisturber::mismatched(core::Nanoseconds now_ns) noexcept {
  const auto found = std::find_if(faults_.begin(), faults_.end(), [&](const Acting& acting) {
    return acting.fault.kind == FaultKind::kBaudMismatch && acting.fault.acts_at(now_ns);
  });
  return found == faults_.end() ? nullptr : &*found;
}

bool LinkDisturber::misread(Acting& line, std::span<const std::byte> frame) {
  // A receiver that is faster than the sender may see several bytes in one.
  constexpr std::size_t kMostBytesOfOne = 10;
  std::vector<std::byte> received(kMostBytesOfOne * frame.size());
  const auto size = over_uart(frame, line.fault.amount, received);
  const auto before = line.reader->counts().frames;
  line.reader->feed(std::span(received).first(size), *to_);
  return line.reader->counts().frames > before;
}

void LinkDisturber::end_turn(core::Nanoseconds now_ns) {
  while (!waiting_.empty() && waiting_.front().due_ns <= now_ns) {
    arrive(waiting_.front().message);
    waiting_.pop_front();
  }
  for (const auto& acting : faults_) {
    if (acting.fault.kind == FaultKind::kFlood && acting.fault.acts_at(now_ns)) {
      for (double sent = 0; sent < acting.fault.amount; ++sent) {
        to_->on(protocol::CurrentSample{.time_ns = now_ns});
      }
    }
  }
}

}  // namespace towbench::harness
