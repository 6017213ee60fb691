#include "harness/snapshots/snapshots.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <iterator>
#include <sstream>
#include <system_error>

#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/checks/check.h"
#include "harness/fault_cases/case_run.h"
#include "harness/lockstep/operator.h"

namespace towbench::harness {
namespace {

// A child that does not outlive its parent. Throws std::system_error.
pid_t fork_bound() {
  const auto parent = getpid();
  const auto child = fork();
  if (child < 0) {
    throw std::system_error(errno, std::generic_category(), "fork");
  }
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) {
      _exit(kExitRuntime);
    }
  }
  return child;
}

int wait_for(pid_t child) noexcept {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

// Empty: the other end is closed, or it sent an empty message, which ends the conversation.
std::string receive(int socket) {
  std::string text(kLongestAnswer, '\0');
  ssize_t length = -1;
  do {
    length = recv(socket, text.data(), text.size(), 0);
  } while (length < 0 && errno == EINTR);
  text.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
  return text;
}

bool send_to(int socket, const std::string& text) noexcept {
  return send(socket, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
}

std::array<int, 2> socket_pair() {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw std::system_error(errno, std::generic_category(), "socketpair");
  }
  return ends;
}

// First letter of a message to the asker, so that an empty answer is a message too.
constexpr char kAnswered = 'a';
constexpr char kEnded = 'e';  // the process of the run ended without an answer

}  // namespace

// At each moment the process forks: the parent stays there and serves requests, the child runs on
// to the next moment.
class Snapshots::HeldRun final : public Operator {
 public:
  HeldRun(const std::vector<core::Nanoseconds>& moments_ns, const std::vector<int>& sockets,
          int ready, const SnapshotWork& work, Injection& injection)
      : moments_ns_(moments_ns),
        sockets_(sockets),
        ready_(ready),
        work_(work),
        injection_(injection) {}

  [[nodiscard]] std::span<const OperatorAct> at(core::Nanoseconds now_ns,
                                                SteeredBench& bench) override {
    while (!goes_on_ && next_ < moments_ns_.size() && now_ns >= moments_ns_[next_]) {
      const auto child = fork_bound();
      if (child == 0) {
        close(sockets_[next_++]);
        taken_ += std::to_string(now_ns) + ' ';
        continue;
      }
      keep_socket(next_);
      serve(child);
      inject_into(bench);
    }
    return {};
  }
  [[nodiscard]] bool holds() const override { return false; }

  [[nodiscard]] bool goes_on() const noexcept { return goes_on_; }
  // The run without a fault is over: when each moment was saved, of those that it reached.
  void tell_taken() const noexcept { (void)send_to(ready_, taken_); }
  void answer(std::unique_ptr<CaseRecord> run) {
    (void)send_to(socket_, kAnswered + work_.answer(request_, std::move(run)));
  }

 private:
  // Only the process at a moment keeps its socket open, so that the asker sees when it ends.
  void keep_socket(std::size_t moment) noexcept {
    socket_ = sockets_[moment];
    for (std::size_t i = moment + 1; i < sockets_.size(); ++i) {
      close(sockets_[i]);
    }
    close(ready_);
  }

  // Returns only in a child that runs a request; the process itself ends here.
  void serve(pid_t next) {
    while (true) {
      request_ = receive(socket_);
      if (request_.empty()) {
        (void)wait_for(next);
        _exit(0);
      }
      const auto child = fork_bound();
      if (child == 0) {
        goes_on_ = true;
        return;
      }
      if (wait_for(child) != 0) {
        (void)send_to(socket_, std::string(1, kEnded));
      }
    }
  }

  void inject_into(SteeredBench& bench) {
    auto planned = work_.injection(request_);
    // By the run's own schedule: the record keeps its time by it.
    injection_.host = std::move(planned.host);
    planned.host = {};
    if (!bench.inject(planned)) {
      _exit(kExitRuntime);
    }
  }

  const std::vector<core::Nanoseconds>& moments_ns_;
  const std::vector<int>& sockets_;
  int ready_;
  const SnapshotWork& work_;
  Injection& injection_;
  std::size_t next_ = 0;
  std::string taken_;
  int socket_ = -1;
  bool goes_on_ = false;
  std::string request_;
};

void Snapshots::hold(const ExperimentFixture& plain, std::uint64_t seed,
                     const std::vector<core::Nanoseconds>& moments_ns,
                     const std::vector<int>& sockets, int ready, const SnapshotWork& work) {
  try {
    Injection injection;
    HeldRun held(moments_ns, sockets, ready, work, injection);
    auto run =
        run_case(plain, plain.rig.parameters, injection, {.seed = seed, .run_operator = &held});
    if (held.goes_on()) {
      held.answer(std::move(run));
    } else {
      held.tell_taken();
    }
  } catch (const std::exception&) {
    _exit(kExitRuntime);  // the asker gets kEnded
  }
  _exit(0);
}

Snapshots::Snapshots(const ExperimentFixture& plain, std::uint64_t seed,
                     const std::vector<core::Nanoseconds>& moments_ns, SnapshotWork work) {
  std::vector<int> far_ends;
  for (std::size_t i = 0; i < moments_ns.size(); ++i) {
    const auto ends = socket_pair();
    sockets_.push_back(ends[0]);
    far_ends.push_back(ends[1]);
  }
  const auto ready = socket_pair();
  first_ = fork_bound();
  if (first_ == 0) {
    std::for_each(sockets_.begin(), sockets_.end(), close);
    close(ready[0]);
    hold(plain, seed, moments_ns, far_ends, ready[1], work);
  }
  std::for_each(far_ends.begin(), far_ends.end(), close);
  close(ready[1]);
  // Moments behind the end of the script are not saved; none when the run itself ended its process.
  std::istringstream taken(receive(ready[0]));
  close(ready[0]);
  taken_ns_.assign(std::istream_iterator<core::Nanoseconds>(taken), {});
}

Snapshots::~Snapshots() {
  for (const int socket : sockets_) {
    // Another process that was forked since may have this end too: no end of file, but an empty
    // message.
    (void)send(socket, "", 0, MSG_NOSIGNAL);
    close(socket);
  }
  (void)wait_for(first_);
}

std::optional<std::string> Snapshots::ask(core::Nanoseconds from_ns, const std::string& request) {
  // What the plant sends at the end of an exchange has crossed the link when its moment is saved.
  const auto too_late =
      std::lower_bound(taken_ns_.begin(), taken_ns_.end(), std::max<core::Nanoseconds>(from_ns, 1));
  if (too_late == taken_ns_.begin() || request.empty()) {
    return std::nullopt;
  }
  const int socket = sockets_[static_cast<std::size_t>(too_late - taken_ns_.begin()) - 1];
  if (!send_to(socket, request)) {
    return std::nullopt;
  }
  auto answer = receive(socket);
  if (answer.empty() || answer.front() != kAnswered) {
    return std::nullopt;
  }
  return answer.substr(1);
}

std::vector<core::Nanoseconds> even_moments(core::Nanoseconds end_ns, std::size_t count) {
  std::vector<core::Nanoseconds> moments_ns;
  for (std::size_t i = 0; i < count; ++i) {
    moments_ns.push_back(end_ns * static_cast<core::Nanoseconds>(i) /
                         static_cast<core::Nanoseconds>(count));
  }
  return moments_ns;
}

}  // namespace towbench::harness
