#include "protocol/carriers/local_socket.h"

#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace towbench::protocol {
namespace {

using core::ErrorCode;
using core::kNanosecondsPerMillisecond;

constexpr core::Nanoseconds kSoon_ns = 5 * core::kNanosecondsPerSecond;

class LocalSocketTest : public testing::Test {
 protected:
  LocalSocketTest() {
    std::string name = (std::filesystem::temp_directory_path() / "towbench-test-XXXXXX").string();
    directory_ = ::mkdtemp(name.data());
    path_ = directory_ / "bench.socket";
  }
  ~LocalSocketTest() override { std::filesystem::remove_all(directory_); }

  std::unique_ptr<LocalServer> serve() {
    auto server = LocalServer::listen(path_);
    EXPECT_TRUE(server.has_value()) << (server ? "" : server.error().message);
    return server ? std::move(*server) : nullptr;
  }

  std::string refusal(const std::filesystem::path& path) {
    const auto server = LocalServer::listen(path);
    return server ? "" : server.error().message;
  }

  std::filesystem::path directory_;
  std::filesystem::path path_;
};

std::span<const std::byte> sent_bytes(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

std::string read_text(LocalSocket& end) {
  std::array<std::byte, 100> bytes{};
  const auto size = end.read_some(bytes, kSoon_ns);
  std::string text;
  for (std::size_t i = 0; size && i < *size; ++i) {
    text += static_cast<char>(bytes[i]);
  }
  return text;
}

ErrorCode read_error(LocalSocket& end) {
  std::array<std::byte, 100> bytes{};
  const auto size = end.read_some(bytes, kSoon_ns);
  return size ? ErrorCode::kNone : size.error();
}

TEST_F(LocalSocketTest, CarriesBytesBothWays) {
  const auto server = serve();
  auto client = LocalSocket::connect(path_);
  ASSERT_TRUE(client.has_value());
  auto end = server->accept(kSoon_ns);
  ASSERT_TRUE(end.has_value());
  ASSERT_TRUE((*client)->write(sent_bytes("duty")).has_value());
  EXPECT_EQ(read_text(**end), "duty");
  ASSERT_TRUE((*end)->write(sent_bytes("edges")).has_value());
  EXPECT_EQ(read_text(**client), "edges");
}

TEST_F(LocalSocketTest, IsPrivateToItsOwner) {
  directory_ /= "made";
  path_ = directory_ / "bench.socket";
  const auto server = serve();
  struct stat status {};
  ASSERT_EQ(::stat(directory_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0700U);
  ASSERT_EQ(::stat(path_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
}

TEST_F(LocalSocketTest, RefusesADirectoryThatOthersMayEnter) {
  std::filesystem::permissions(directory_, std::filesystem::perms::others_exec,
                               std::filesystem::perm_options::add);
  EXPECT_NE(refusal(path_).find("mode 0700"), std::string::npos);
}

TEST_F(LocalSocketTest, RefusesALinkToADirectory) {
  const auto real = directory_ / "real";
  std::filesystem::create_directory(real);
  std::filesystem::create_directory_symlink(real, directory_ / "link");
  EXPECT_NE(refusal(directory_ / "link" / "bench.socket").find("not a directory"),
            std::string::npos);
}

TEST_F(LocalSocketTest, RefusesAPathThatIsServedAlready) {
  const auto server = serve();
  EXPECT_NE(refusal(path_).find("another process listens"), std::string::npos);
  EXPECT_TRUE(LocalSocket::connect(path_).has_value()) << "the first server is unharmed";
}

TEST_F(LocalSocketTest, RefusesAPathServedBySomeoneWhoKnowsNoLock) {
  boost::asio::io_context context;
  const boost::asio::local::stream_protocol::acceptor foreign(
      context, boost::asio::local::stream_protocol::endpoint(path_.string()));
  EXPECT_NE(refusal(path_).find("another process listens"), std::string::npos);
}

TEST_F(LocalSocketTest, NeverRemovesAFileThatIsNoSocket) {
  std::ofstream(path_) << "precious";
  EXPECT_NE(refusal(path_).find("not a socket"), std::string::npos);
  EXPECT_EQ(std::filesystem::file_size(path_), 8U);
}

TEST_F(LocalSocketTest, RefusesAPathTooLongForASocket) {
  EXPECT_NE(refusal(directory_ / std::string(120, 'a')).find("too long"), std::string::npos);
  EXPECT_FALSE(LocalSocket::connect(directory_ / std::string(120, 'a')).has_value());
}

TEST_F(LocalSocketTest, ReplacesTheSocketOfAServerThatWasKilled) {
  const pid_t child = ::fork();
  if (child == 0) {
    const auto server = LocalServer::listen(path_);
    ::kill(::getpid(), SIGKILL);
  }
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  ASSERT_TRUE(std::filesystem::exists(path_));
  EXPECT_NE(serve(), nullptr);
}

TEST_F(LocalSocketTest, RemovesItsSocketAtTheEnd) {
  serve().reset();
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(LocalSocketTest, WaitsForAServerThatIsStillStartingUp) {
  std::unique_ptr<LocalSocket> client;
  std::thread connecting([&] {
    if (auto end = LocalSocket::connect(path_, kSoon_ns)) {
      client = std::move(*end);
    }
  });
  const auto server = serve();
  const bool accepted = server->accept(kSoon_ns).has_value();
  connecting.join();
  EXPECT_TRUE(accepted);
  EXPECT_NE(client, nullptr);
}

TEST_F(LocalSocketTest, GivesUpOnAServerThatNeverComes) {
  const auto client = LocalSocket::connect(path_, kNanosecondsPerMillisecond);
  ASSERT_FALSE(client.has_value());
  EXPECT_EQ(client.error().code, ErrorCode::kPeerSilent);
  EXPECT_NE(client.error().message.find(path_.string()), std::string::npos);
}

TEST_F(LocalSocketTest, GivesUpOnAPeerThatNeverComes) {
  const auto server = serve();
  EXPECT_EQ(server->accept(kNanosecondsPerMillisecond).error().code, ErrorCode::kPeerSilent);
}

TEST_F(LocalSocketTest, ReadsNothingInTimeAndAtOnceWithoutATimeout) {
  auto ends = LocalSocket::pair();
  std::array<std::byte, 10> bytes{};
  EXPECT_EQ(ends->first->read_some(bytes, 0).value(), 0U);
  EXPECT_EQ(ends->first->read_some(bytes, kNanosecondsPerMillisecond).value(), 0U);
}

TEST_F(LocalSocketTest, DeliversWhatWasSentBeforeTheEndAndThenTheEnd) {
  auto ends = LocalSocket::pair();
  ASSERT_TRUE(ends->second->write(sent_bytes("last")).has_value());
  ends->second.reset();
  EXPECT_EQ(read_text(*ends->first), "last");
  EXPECT_EQ(read_error(*ends->first), ErrorCode::kPeerClosed);
}

TEST_F(LocalSocketTest, WritingToAPeerThatHasGoneIsAnErrorAndNotASignal) {
  auto ends = LocalSocket::pair();
  ends->second.reset();
  const auto status = ends->first->write(sent_bytes("x"));
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error(), ErrorCode::kPeerClosed);
}

TEST_F(LocalSocketTest, GivesUpOnAPeerThatTakesNothing) {
  auto ends = LocalSocket::pair();
  ends->first->set_silence_limit(kNanosecondsPerMillisecond);
  const std::vector<std::byte> much(4'000'000);
  EXPECT_EQ(ends->first->write(much).error(), ErrorCode::kPeerSilent);
}

TEST_F(LocalSocketTest, CarriesMoreThanItsBufferHolds) {
  auto ends = LocalSocket::pair();
  const std::vector<std::byte> much(3'000'000, std::byte{7});
  bool sent = false;
  std::thread sending([&] { sent = ends->first->write(much).has_value(); });
  std::vector<std::byte> part(50'000);
  std::size_t received = 0;
  while (received < much.size()) {
    const auto size = ends->second->read_some(part, kSoon_ns);
    ASSERT_TRUE(size.has_value());
    received += *size;
  }
  sending.join();
  EXPECT_TRUE(sent);
  EXPECT_EQ(received, much.size());
}

TEST_F(LocalSocketTest, TakesOverAnInheritedDescriptor) {
  int ends[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  auto mine = LocalSocket::adopt(ends[0]);
  auto theirs = LocalSocket::adopt(ends[1]);
  ASSERT_TRUE(mine.has_value() && theirs.has_value());
  ASSERT_TRUE((*mine)->write(sent_bytes("hello")).has_value());
  EXPECT_EQ(read_text(**theirs), "hello");
  EXPECT_FALSE(LocalSocket::adopt(-1).has_value());
}

TEST_F(LocalSocketTest, IsNotInheritedByPrograms) {
  auto ends = LocalSocket::pair();
  const pid_t child = ::fork();
  if (child == 0) {
    // Lives until its standard input ends; an inherited end would keep the link alive that long.
    ::execlp("sleep", "sleep", "60", nullptr);
    ::_exit(1);
  }
  ends->second.reset();
  EXPECT_EQ(read_error(*ends->first), ErrorCode::kPeerClosed);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

}  // namespace
}  // namespace towbench::protocol
