#include "study/prediction/in_parallel.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace towbench::study::diagnose {

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  const auto take = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      work(i);
    }
  };
  const std::size_t workers =
      std::min<std::size_t>(count, std::max(1U, std::thread::hardware_concurrency()));
  std::vector<std::jthread> others;
  for (std::size_t w = 1; w < workers; ++w) {
    others.emplace_back(take);
  }
  take();
}

}  // namespace towbench::study::diagnose
