#include "harness/campaign/worker_pool.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <deque>
#include <map>
#include <optional>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace towbench::harness {
namespace {

// One more than it works on, so that it never waits for the next.
constexpr std::size_t kMostInHand = 2;

// A process that is told the indices of cases and answers with their lines, over one socket.
struct Worker {
  pid_t id = -1;
  int socket = -1;
  std::optional<std::size_t> machine;  // that its cases are of: it keeps one at a time
  std::deque<std::size_t> in_hand;     // what it has not answered yet, in its order
  std::string received;
};

bool send_whole(int socket, const char* bytes, std::size_t size) noexcept {
  for (std::size_t sent = 0; sent < size;) {
    const auto count = send(socket, bytes + sent, size - sent, MSG_NOSIGNAL);
    if (count < 0 && errno != EINTR) {
      return false;  // nobody listens any more
    }
    sent += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  return true;
}

bool receive_whole(int socket, void* bytes, std::size_t size) noexcept {
  auto* into = static_cast<char*>(bytes);
  for (std::size_t received = 0; received < size;) {
    const auto count = recv(socket, into + received, size - received, 0);
    if (count == 0 || (count < 0 && errno != EINTR)) {
      return false;
    }
    received += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  return true;
}

// Nothing of it may go on as if it were the process that it came from.
[[noreturn]] void work(int socket, const Campaign& campaign,
                       std::span<const CampaignCase> cases) noexcept {
  for (std::size_t index = 0; receive_whole(socket, &index, sizeof index);) {
    const auto line = run_campaign_case(campaign, cases[index]) + '\n';
    if (!send_whole(socket, line.data(), line.size())) {
      break;
    }
  }
  _exit(0);
}

std::string ended_how(int status) {
  return WIFSIGNALED(status)
             ? fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)))
             : fmt::format("ended with code {}", WEXITSTATUS(status));
}

// Cases by machine: a worker goes on with its own, then with the one that has most left for each
// who works on it.
class Queues {
 public:
  explicit Queues(std::span<const CampaignCase> cases) : cases_(cases) {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      by_machine_[cases[i].machine].push_back(i);
    }
  }

  [[nodiscard]] bool empty() const noexcept { return by_machine_.empty(); }
  void put_back(std::size_t index) { by_machine_[cases_[index].machine].push_front(index); }

  // Must not be empty.
  std::size_t take(Worker& worker, const std::vector<Worker>& all) {
    if (!worker.machine || !by_machine_.contains(*worker.machine)) {
      worker.machine.reset();
      worker.machine = fullest(all);
    }
    const auto queue = by_machine_.find(*worker.machine);
    const auto index = queue->second.front();
    queue->second.pop_front();
    if (queue->second.empty()) {
      by_machine_.erase(queue);
    }
    return index;
  }

 private:
  [[nodiscard]] std::size_t fullest(const std::vector<Worker>& all) const {
    std::size_t best = by_machine_.begin()->first;
    std::size_t most = 0;
    for (const auto& [machine, queue] : by_machine_) {
      const auto busy = static_cast<std::size_t>(
          std::count_if(all.begin(), all.end(),
                        [&, id = machine](const Worker& each) { return each.machine == id; }));
      if (queue.size() / (1 + busy) > most) {
        most = queue.size() / (1 + busy);
        best = machine;
      }
    }
    return best;
  }

  std::span<const CampaignCase> cases_;
  std::map<std::size_t, std::deque<std::size_t>> by_machine_;
};

class Pool {
 public:
  Pool(const Campaign& campaign, std::span<const CampaignCase> cases,
       const std::function<void(const std::string&)>& take)
      : campaign_(campaign), cases_(cases), take_(take), queues_(cases) {}
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  ~Pool() {
    for (auto& worker : workers_) {
      if (worker.id > 0) {
        kill(worker.id, SIGKILL);
        (void)end(worker);
      }
    }
  }

  void run(std::size_t count, const std::atomic<bool>& stop) {
    workers_.resize(count);
    for (auto& worker : workers_) {
      start(worker);
    }
    while (listen() && !stop.load(std::memory_order_relaxed)) {
    }
  }

 private:
  // Does nothing when there is nothing left to do.
  void start(Worker& worker) {
    if (queues_.empty()) {
      return;
    }
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) != 0) {
      throw std::system_error(errno, std::generic_category(), "socketpair");
    }
    worker.id = fork();
    if (worker.id < 0) {
      throw std::system_error(errno, std::generic_category(), "fork");
    }
    if (worker.id == 0) {
      for (const auto& other : workers_) {  // or it would keep them open
        if (other.socket >= 0) {
          close(other.socket);
        }
      }
      close(ends[0]);
      work(ends[1], campaign_, cases_);
    }
    close(ends[1]);
    worker.socket = ends[0];
    worker.received.clear();
    hand_out(worker);
  }

  // Whoever has nothing left is told so.
  void hand_out(Worker& worker) {
    while (worker.in_hand.size() < kMostInHand && !queues_.empty()) {
      const auto index = queues_.take(worker, workers_);
      worker.in_hand.push_back(index);
      // One that has died meanwhile shows in its answer.
      (void)send_whole(worker.socket, reinterpret_cast<const char*>(&index),  // NOLINT: its bytes
                       sizeof index);
    }
    if (worker.in_hand.empty()) {
      (void)end(worker);
    }
  }

  // Returns how it ended.
  static int end(Worker& worker) {
    int status = 0;
    close(worker.socket);
    waitpid(worker.id, &status, 0);
    worker.id = -1;
    worker.socket = -1;
    worker.machine.reset();
    return status;
  }

  // False when nobody is left.
  bool listen() {
    std::vector<pollfd> waiting;
    std::vector<Worker*> owners;
    for (auto& worker : workers_) {
      if (worker.id > 0) {
        waiting.push_back({.fd = worker.socket, .events = POLLIN, .revents = 0});
        owners.push_back(&worker);
      }
    }
    constexpr int kLookForSignals_ms = 200;
    if (waiting.empty() || poll(waiting.data(), waiting.size(), kLookForSignals_ms) < 0) {
      return !waiting.empty();
    }
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      if (waiting[i].revents != 0) {
        receive(*owners[i]);
      }
    }
    return true;
  }

  void receive(Worker& worker) {
    std::array<char, 65536> bytes{};
    const auto count = read(worker.socket, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) {
      return;
    }
    if (count <= 0) {
      bury(worker);
      return;
    }
    worker.received.append(bytes.data(), static_cast<std::size_t>(count));
    for (auto at = worker.received.find('\n'); at != std::string::npos;
         at = worker.received.find('\n')) {
      take_(worker.received.substr(0, at));
      worker.received.erase(0, at + 1);
      worker.in_hand.pop_front();
    }
    hand_out(worker);
  }

  // The case that it was at is what ended it; the next gets a new process.
  void bury(Worker& worker) {
    const auto how = ended_how(end(worker));
    if (!worker.in_hand.empty()) {
      take_(crashed_case(campaign_, cases_[worker.in_hand.front()], how));
      worker.in_hand.pop_front();
    }
    for (; !worker.in_hand.empty(); worker.in_hand.pop_back()) {
      queues_.put_back(worker.in_hand.back());
    }
    start(worker);
  }

  const Campaign& campaign_;
  std::span<const CampaignCase> cases_;
  const std::function<void(const std::string&)>& take_;
  Queues queues_;
  std::vector<Worker> workers_;
};

}  // namespace

void run_in_workers(const Campaign& campaign, std::span<const CampaignCase> cases,
                    std::size_t workers, const std::atomic<bool>& stop,
                    const std::function<void(const std::string&)>& take) {
  if (!cases.empty()) {
    Pool(campaign, cases, take).run(workers, stop);
  }
}

}  // namespace towbench::harness
