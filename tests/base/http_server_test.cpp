#include "base/http_server.h"

#include <doctest/doctest.h>

#include <list>
#include <system_error>

#include "support/http.h"

using namespace duet;
using namespace duet::test;

namespace {

HttpAnswer echo(const std::string& target) {
  if (target == "/nothing") return {204, "", ""};
  return {200, "text/x", "you asked for " + target};
}

/// A request with these header fields.
std::string request(const std::string& line, const std::string& fields) {
  return line + "\r\n" + fields + "\r\n";
}

/// The first line of the answer.
std::string status(uint16_t port, const std::string& text) {
  const std::string answer = http(port, text);
  return answer.substr(0, answer.find("\r\n"));
}

}  // namespace

TEST_CASE("a server of pages answers GET requests for its own host") {
  const HttpServer server(0, echo);
  const uint16_t port = server.port();
  const std::string host = "Host: 127.0.0.1:" + std::to_string(port) + "\r\n";
  CHECK(http(port, request("GET /a?b=1 HTTP/1.1", "Accept: */*\r\n" + host)) ==
        "HTTP/1.1 200 OK\r\nConnection: close\r\nCache-Control: no-store\r\n"
        "Content-Type: text/x\r\nX-Content-Type-Options: nosniff\r\nContent-Length: 20\r\n\r\n"
        "you asked for /a?b=1");
  CHECK(status(port, request("GET / HTTP/1.0", "hOsT:localhost:" + std::to_string(port) +
                                                   "\r\n")) == "HTTP/1.1 200 OK");
  CHECK(http_get(port, "/nothing").status == 204);
  CHECK(http_get(port, "/nothing").body.empty());
  // As slow networks bring it.
  const Connection slow(port);
  for (const char c : request("GET /slow HTTP/1.1", host)) slow.send(std::string(1, c));
  CHECK(slow.receive().ends_with("you asked for /slow"));
}

TEST_CASE("a server of pages refuses what it should not answer") {
  const HttpServer server(0, echo);
  const uint16_t port = server.port();
  const std::string host = "Host: 127.0.0.1:" + std::to_string(port) + "\r\n";
  // A page of the web whose name leads here has its own name in requests.
  CHECK(status(port, request("GET / HTTP/1.1", "Host: evil.example:" + std::to_string(port) +
                                                   "\r\n")) == "HTTP/1.1 403 Forbidden");
  CHECK(status(port, request("GET / HTTP/1.1", "")) == "HTTP/1.1 400 Bad Request");
  CHECK(status(port, request("GET / HTTP/1.1", "X-Host: 127.0.0.1\r\n")) ==
        "HTTP/1.1 400 Bad Request");
  CHECK(status(port, request("POST / HTTP/1.1", host)) == "HTTP/1.1 405 Method Not Allowed");
  for (const char* line : {"", "GET", "GET ", "GET /", "GET / FTP/1", "GET  HTTP/1.1", "\xff\xfe"})
    CHECK(status(port, request(line, host)) == "HTTP/1.1 400 Bad Request");
  CHECK(status(port, "GET / HTTP/1.1\r\nX: " + std::string(9000, 'x')) ==
        "HTTP/1.1 431 Request Header Fields Too Large");
}

TEST_CASE("connections that say nothing hold nobody up") {
  const HttpServer server(0, echo);
  std::list<Connection> idle;
  for (int i = 0; i < 64; ++i) idle.emplace_back(server.port());
  CHECK(http_get(server.port(), "/a").status == 200);
}

TEST_CASE("of two servers at one port the second is refused") {
  const HttpServer server(0, echo);
  CHECK_THROWS_AS(HttpServer(server.port(), echo), std::system_error);
}
