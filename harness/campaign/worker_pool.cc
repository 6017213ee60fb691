#include "harness/campaign/worker_pool.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <deque>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace towbench::harness {
namespace {

// A process with the share of the cases that it works off, and the pipe on which it answers.
struct Worker {
  pid_t id = -1;
  int pipe = -1;
  std::deque<const CampaignCase*> share;  // what it has not answered yet, in its order
  std::string received;
};

void write_line(int file, std::string line) {
  line += '\n';
  for (std::size_t sent = 0; sent < line.size();) {
    const auto written = write(file, line.data() + sent, line.size() - sent);
    if (written < 0 && errno != EINTR) {
      _exit(1);  // nobody listens any more
    }
    sent += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
}

void start(Worker& worker, const Campaign& campaign) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe");
  }
  worker.id = fork();
  if (worker.id < 0) {
    throw std::system_error(errno, std::generic_category(), "fork");
  }
  if (worker.id == 0) {
    close(ends[0]);
    for (const auto* one : worker.share) {
      write_line(ends[1], run_campaign_case(campaign, *one));
    }
    _exit(0);
  }
  close(ends[1]);
  worker.pipe = ends[0];
  worker.received.clear();
}

std::string ended_how(int status) {
  return WIFSIGNALED(status)
             ? fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)))
             : fmt::format("ended with code {}", WEXITSTATUS(status));
}

class Pool {
 public:
  Pool(const Campaign& campaign, const std::function<void(const std::string&)>& take)
      : campaign_(campaign), take_(take) {}
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  ~Pool() {
    for (auto& worker : workers_) {
      if (worker.id > 0) {
        kill(worker.id, SIGKILL);
        close(worker.pipe);
        waitpid(worker.id, nullptr, 0);
      }
    }
  }

  void run(std::span<const CampaignCase> cases, std::size_t count, const std::atomic<bool>& stop) {
    workers_.resize(count);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      workers_[i % count].share.push_back(&cases[i]);
    }
    for (auto& worker : workers_) {
      if (!worker.share.empty()) {
        start(worker, campaign_);
      }
    }
    while (listen() && !stop.load(std::memory_order_relaxed)) {
    }
  }

 private:
  // False when nobody is left.
  bool listen() {
    std::vector<pollfd> waiting;
    std::vector<Worker*> owners;
    for (auto& worker : workers_) {
      if (worker.id > 0) {
        waiting.push_back({.fd = worker.pipe, .events = POLLIN, .revents = 0});
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
    const auto count = read(worker.pipe, bytes.data(), bytes.size());
    if (count < 0) {
      return;
    }
    if (count == 0) {
      bury(worker);
      return;
    }
    worker.received.append(bytes.data(), static_cast<std::size_t>(count));
    for (auto end = worker.received.find('\n'); end != std::string::npos;
         end = worker.received.find('\n')) {
      take_(worker.received.substr(0, end));
      worker.received.erase(0, end + 1);
      worker.share.pop_front();
    }
  }

  // The case in hand, if any, is what ended it; the rest of its share gets a new process.
  void bury(Worker& worker) {
    int status = 0;
    close(worker.pipe);
    waitpid(worker.id, &status, 0);
    worker.id = -1;
    if (worker.share.empty()) {
      return;
    }
    take_(crashed_case(campaign_, *worker.share.front(), ended_how(status)));
    worker.share.pop_front();
    if (!worker.share.empty()) {
      start(worker, campaign_);
    }
  }

  const Campaign& campaign_;
  const std::function<void(const std::string&)>& take_;
  std::vector<Worker> workers_;
};

}  // namespace

void run_in_workers(const Campaign& campaign, std::span<const CampaignCase> cases,
                    std::size_t workers, const std::atomic<bool>& stop,
                    const std::function<void(const std::string&)>& take) {
  if (!cases.empty()) {
    Pool(campaign, take).run(cases, workers, stop);
  }
}

}  // namespace towbench::harness
