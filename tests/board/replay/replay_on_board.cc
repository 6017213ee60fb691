// replay_on_board IMAGE INPUTS OUTPUTS: executes bbmc/baremetal's replay.elf on the virtual board
// with the recorded messages in its memory and writes what it answers. tools/baremetal_duty.sh
// compares.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

#include "board/board.h"
#include "tests/board/replay/files_in_memory.h"

namespace {

using namespace towbench;

// Of virtual time: the replay takes three seconds of it.
constexpr core::Nanoseconds kLimit_ns = 60 * core::kNanosecondsPerSecond;

int replay(const char* image_file, const char* inputs_file, const char* outputs_file) {
  auto image = board::ElfImage::read(image_file);
  std::ifstream stream(inputs_file, std::ios::binary);
  const std::vector<char> inputs((std::istreambuf_iterator<char>(stream)), {});
  board::Board board;
  if (!image || inputs.empty() || !board.load(std::move(*image)).empty()) {
    std::fputs("image or inputs cannot be read\n", stderr);
    return 2;
  }
  const auto symbol = board.image().find("bbmc_memory_files");
  const auto memory =
      board.memory(bbmc::MemoryFiles::kInput, static_cast<std::uint32_t>(inputs.size()));
  if (!symbol || memory.empty()) {
    std::fputs("the image has no place for the inputs\n", stderr);
    return 2;
  }
  std::copy(inputs.begin(), inputs.end(), memory.begin());
  auto* files = reinterpret_cast<bbmc::MemoryFiles*>(
      board.memory(symbol->address, sizeof(bbmc::MemoryFiles)).data());
  files->input_size = static_cast<std::uint32_t>(inputs.size());
  while (files->ended == 0 && !board.verdict() && board.now_ns() < kLimit_ns) {
    board.run_until(board.now_ns() + 100 * core::kNanosecondsPerMillisecond);
  }
  std::fputs(board.uart().take_sent().c_str(), stderr);
  if (files->ended == 0) {
    std::fprintf(stderr, "%s\n", board.verdict() ? board.verdict()->sentence.c_str() : "no end");
    return 1;
  }
  const auto answer = board.memory(bbmc::MemoryFiles::kOutput, files->output_size);
  std::ofstream out(outputs_file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(answer.data()),
            static_cast<std::streamsize>(answer.size()));
  return out.good() ? files->status : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: replay_on_board IMAGE INPUTS OUTPUTS\n", stderr);
    return 2;
  }
  return replay(argv[1], argv[2], argv[3]);
}
