#include "harness/panel/web_routes.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kHost = "127.0.0.1:8080";

class WebRoutesTest : public ::testing::Test {
 protected:
  WebRoutesTest() {
    fs::create_directories(root_ / "runs" / "one");
    write(root_ / "runs" / "one" / "report.html", "<p>a report");
    write(root_ / "secret.txt", "a secret");
    fs::create_symlink(root_ / "secret.txt", root_ / "runs" / "one" / "link.txt");
    fs::create_directory_symlink(root_, root_ / "runs" / "two");
  }
  ~WebRoutesTest() override { fs::remove_all(root_); }

  static void write(const fs::path& file, const char* text) { std::ofstream(file) << text; }
  WebAnswer get(const std::string& target, const std::string& cookie) {
    return routes_.answer({.method = "GET",
                           .target = target,
                           .host = kHost,
                           .origin = "",
                           .cookie = "towbench=" + cookie});
  }

  fs::path root_ = [] {
    auto pattern = (fs::temp_directory_path() / "towbench-routes-XXXXXX").string();
    return fs::path(mkdtemp(pattern.data()));
  }();
  WebKeys keys_;
  WebRoutes routes_{root_ / "runs", {kHost}, keys_};
};

TEST_F(WebRoutesTest, ATicketIsExchangedForACookieOnce) {
  const auto ticket = keys_.ticket();
  EXPECT_EQ(ticket.size(), 32U);
  const auto let_in = get("/?ticket=" + ticket, "");
  EXPECT_EQ(let_in.status, 303U);
  EXPECT_THAT(let_in.cookie, HasSubstr("HttpOnly; SameSite=Strict"));
  EXPECT_NE(keys_.ticket(), ticket);
  EXPECT_EQ(get("/?ticket=" + ticket, "").status, 403U);
}

TEST_F(WebRoutesTest, WithoutACookieThereIsNothing) {
  for (const char* target :
       {"/", "/panel.js", "/api/catalogue", "/api/folders", "/runs/one/report.html"}) {
    const auto answer = get(target, "guess");
    EXPECT_EQ(answer.status, 403U) << target;
    EXPECT_FALSE(answer.file) << target;
  }
}

TEST_F(WebRoutesTest, AFileOfARunIsServed) {
  const auto cookie = keys_.exchange(keys_.ticket());
  const auto answer = get("/runs/one/report.html", cookie);
  EXPECT_EQ(answer.status, 200U);
  ASSERT_TRUE(answer.file);
  EXPECT_EQ(answer.file->filename(), "report.html");
}

TEST_F(WebRoutesTest, NothingOutsideTheRunsIsServedWhateverTheName) {
  const auto cookie = keys_.exchange(keys_.ticket());
  for (const char* target :
       {"/runs/../secret.txt", "/runs/one/../../secret.txt", "/runs/one/link.txt",
        "/runs/two/secret.txt", "/runs/%2e%2e/secret.txt", "/runs//one/report.html", "/runs/",
        "/runs/one", "/runs/one/", "/runs/.git/config.toml", "/runs/one/report.html/",
        "/secret.txt"}) {
    const auto answer = get(target, cookie);
    EXPECT_EQ(answer.status, 404U) << target;
    EXPECT_FALSE(answer.file) << target;
  }
}

TEST_F(WebRoutesTest, APageFromElsewhereIsRefusedEvenWithTheCookie) {
  const auto cookie = "towbench=" + keys_.exchange(keys_.ticket());
  WebRequest request{.method = "GET",
                     .target = "/api/folders",
                     .host = kHost,
                     .origin = "http://evil.example",
                     .cookie = cookie};
  EXPECT_EQ(routes_.answer(request).status, 403U);
  request.origin = "";
  request.host = "evil.example";
  EXPECT_EQ(routes_.answer(request).status, 421U);
  request.host = kHost;
  EXPECT_EQ(routes_.answer(request).status, 200U);
  request.method = "POST";
  EXPECT_EQ(routes_.answer(request).status, 405U);
}

TEST_F(WebRoutesTest, ASocketNeedsOriginAndCookie) {
  WebRequest request{.method = "GET",
                     .target = "/live",
                     .host = kHost,
                     .origin = std::string("http://") + kHost,
                     .cookie = "towbench=" + keys_.exchange(keys_.ticket())};
  EXPECT_FALSE(routes_.refuse_socket(request));
  auto unauthorized = request;
  unauthorized.cookie = "towbench=";
  EXPECT_TRUE(routes_.refuse_socket(unauthorized));
  unauthorized = request;
  unauthorized.origin = "";
  EXPECT_TRUE(routes_.refuse_socket(unauthorized));
  unauthorized = request;
  unauthorized.target = "/elsewhere";
  EXPECT_TRUE(routes_.refuse_socket(unauthorized));
}

TEST(WebKeys, ForgetsTheOldestOfManyBrowsersAndNeverKnowsAnEmptyCookie) {
  WebKeys keys;
  const auto first = keys.exchange(keys.ticket());
  EXPECT_TRUE(keys.knows(first));
  EXPECT_FALSE(keys.knows(""));
  EXPECT_THAT(keys.exchange(""), IsEmpty());
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(keys.knows(keys.exchange(keys.ticket())));
  }
  EXPECT_FALSE(keys.knows(first));
}

}  // namespace
}  // namespace towbench::harness
