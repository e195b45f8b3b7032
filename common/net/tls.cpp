// SPDX-License-Identifier: MIT
#include "common/net/tls.h"

#include <algorithm>
#include <cassert>

#include <boost/asio/ssl.hpp>
#include <boost/asio/ssl/impl/src.hpp>  // compiled here, once
#include <boost/asio/write.hpp>
#include <openssl/err.h>
#include <openssl/x509v3.h>

#include "common/net/await.h"
#include "common/net/send_pace.h"
#include "common/net/tcp_stream.h"

namespace selvage {

using asio::ip::tcp;
using boost::system::error_code;
namespace ssl = asio::ssl;

class TlsContext {
 public:
  explicit TlsContext(ssl::context::method method) : context(method) {}
  ssl::context context;
};

namespace {

/// ALPN's wire form: a length, then the name.
std::string alpn_list() { return static_cast<char>(kAlpnProtocol.size()) + std::string(kAlpnProtocol); }

int choose_protocol(SSL*, const unsigned char** out, unsigned char* out_length, const unsigned char* offered,
                    unsigned int offered_length, void*) {
  static const std::string ours = alpn_list();
  unsigned char* chosen = nullptr;
  const int found =
      SSL_select_next_proto(&chosen, out_length, reinterpret_cast<const unsigned char*>(ours.data()),
                            static_cast<unsigned>(ours.size()), offered, offered_length);
  *out = chosen;
  return found == OPENSSL_NPN_NEGOTIATED ? SSL_TLSEXT_ERR_OK : SSL_TLSEXT_ERR_ALERT_FATAL;
}

bool speaks_our_protocol(const SSL* connection) {
  const unsigned char* name = nullptr;
  unsigned int length = 0;
  SSL_get0_alpn_selected(connection, &name, &length);
  return length > 0 && std::string_view(reinterpret_cast<const char*>(name), length) == kAlpnProtocol;
}

/// What OpenSSL says of a file that it cannot use.
tl::unexpected<Error> bad_file(const std::filesystem::path& path, const error_code& error, const char* what) {
  if (!std::filesystem::exists(path)) return fail(ErrorCode::NotFound, path.string() + ": no such file");
  return fail(ErrorCode::BadFile, path.string() + ": " + what + " (" + error.message() + ")");
}

Result<std::shared_ptr<TlsContext>> new_context(ssl::context::method method) {
  auto created = std::make_shared<TlsContext>(method);
  SSL_CTX* native = created->context.native_handle();
  SSL_CTX_set_min_proto_version(native, TLS1_3_VERSION);
  // Clients of ours never resume sessions, so tickets would be sent for nothing.
  SSL_CTX_set_num_tickets(native, 0);
  return created;
}

Error describe_refusal(const SSL* connection, const std::string& host, const error_code& error) {
  const long verified = SSL_get_verify_result(connection);
  if (verified == X509_V_OK) return {ErrorCode::Io, "the TLS handshake failed: " + error.message()};
  std::string text = "the certificate of " + host + " is refused: ";
  text += X509_verify_cert_error_string(verified);
  switch (verified) {
    case X509_V_ERR_CERT_HAS_EXPIRED:
    case X509_V_ERR_CERT_NOT_YET_VALID:
      text += "; its operator must renew it, unless a clock is wrong";
      break;
    case X509_V_ERR_HOSTNAME_MISMATCH:
    case X509_V_ERR_IP_ADDRESS_MISMATCH:
      text += "; it was issued for another name or address";
      break;
    default:
      text += "; --ca FILE names the authority to trust";
  }
  return {ErrorCode::Unauthorised, std::move(text)};
}

class TlsStream final : public ByteStream {
 public:
  /// `host` is empty on the server's side.
  TlsStream(tcp::socket socket, std::shared_ptr<TlsContext> context, std::string host)
      : context_(std::move(context)),
        stream_(std::move(socket), context_->context),
        pace_(stream_.next_layer()),
        host_(std::move(host)),
        peer_(peer_of(stream_.next_layer())) {
    error_code ignored;
    stream_.next_layer().set_option(tcp::no_delay(true), ignored);
    if (!host_.empty()) expect_host();
  }

  asio::awaitable<Result<void>> handshake() override {
    const auto side = host_.empty() ? ssl::stream_base::server : ssl::stream_base::client;
    auto [error] = co_await stream_.async_handshake(side, kAwait);
    if (error == asio::error::operation_aborted) co_return failure(error);
    if (error) co_return tl::unexpected<Error>(describe_refusal(native(), host_, error));
    if (!speaks_our_protocol(native())) {
      co_return fail(ErrorCode::Protocol, "the TLS peer does not speak " + std::string(kAlpnProtocol));
    }
    co_return Result<void>();
  }

  /// A peer that ends without TLS's own goodbye is at its end all the same: frames and answers say themselves
  /// whether they are whole.
  asio::awaitable<Result<std::size_t>> read_some(std::span<std::byte> into) override {
    const asio::mutable_buffer room(into.data(), into.size());
    auto [error, count] = co_await stream_.async_read_some(room, kAwait);
    if (error == asio::error::eof || error == ssl::error::stream_truncated) co_return std::size_t{0};
    if (error) co_return failure(error);
    co_return count;
  }

  asio::awaitable<Result<void>> write(const Pieces& pieces) override {
    buffers_.clear();
    for (const Piece& piece : pieces) buffers_.emplace_back(piece.bytes.data(), piece.bytes.size());
    auto [error, count] = co_await asio::async_write(stream_, buffers_, kAwait);
    if (error) co_return failure(error);
    co_return Result<void>();
  }

  asio::awaitable<Result<void>> wait_to_write() override { return pace_.wait(); }
  /// Records are encrypted one by one in any case: large writes save less than they delay.
  std::size_t write_size() const override { return std::min(pace_.write_size(), kUsualWrite); }

  void end_writing() override {
    error_code ignored;
    stream_.next_layer().shutdown(tcp::socket::shutdown_send, ignored);
  }

  void close() override {
    error_code ignored;
    stream_.next_layer().shutdown(tcp::socket::shutdown_both, ignored);
    stream_.next_layer().close(ignored);
  }

  asio::any_io_executor executor() override { return stream_.get_executor(); }
  std::string peer() const override { return peer_; }

 private:
  SSL* native() { return stream_.native_handle(); }

  /// The name goes into the greeting and is checked against the certificate; addresses are only checked.
  void expect_host() {
    X509_VERIFY_PARAM* rules = SSL_get0_param(native());
    if (X509_VERIFY_PARAM_set1_ip_asc(rules, host_.c_str()) == 1) return;
    SSL_set_tlsext_host_name(native(), host_.c_str());
    X509_VERIFY_PARAM_set_hostflags(rules, X509_CHECK_FLAG_NO_PARTIAL_WILDCARDS);
    X509_VERIFY_PARAM_set1_host(rules, host_.c_str(), host_.size());
  }

  static tl::unexpected<Error> failure(const error_code& error) { return connection_failure(error); }

  std::shared_ptr<TlsContext> context_;
  ssl::stream<tcp::socket> stream_;
  SendPace pace_;
  std::vector<asio::const_buffer> buffers_;
  const std::string host_;
  const std::string peer_;
};

}  // namespace

Result<std::shared_ptr<TlsContext>> tls_server_context(const TlsServerFiles& files) {
  auto created = new_context(ssl::context::tls_server);
  ssl::context& context = (*created)->context;
  error_code error;
  context.use_certificate_chain_file(files.certificate.string(), error);
  if (error) return bad_file(files.certificate, error, "not a certificate in PEM");
  // Asks for no pass phrase on the terminal: a server has none.
  context.set_password_callback([](std::size_t, ssl::context::password_purpose) { return std::string(); },
                                error);
  context.use_private_key_file(files.key.string(), ssl::context::pem, error);
  const int reason = ERR_GET_REASON(static_cast<unsigned long>(error.value()));
  if (error && (reason == X509_R_KEY_VALUES_MISMATCH || reason == X509_R_KEY_TYPE_MISMATCH)) {
    return fail(ErrorCode::InvalidArgument,
                files.key.string() + ": not the key of the certificate " + files.certificate.string());
  }
  if (error) return bad_file(files.key, error, "not a private key in PEM without pass phrase");
  SSL_CTX_set_alpn_select_cb(context.native_handle(), choose_protocol, nullptr);
  return created;
}

Result<std::shared_ptr<TlsContext>> tls_client_context(const std::filesystem::path& ca) {
  auto created = new_context(ssl::context::tls_client);
  ssl::context& context = (*created)->context;
  error_code error;
  context.set_verify_mode(ssl::verify_peer, error);
  if (ca.empty()) {
    context.set_default_verify_paths(error);
  } else {
    context.load_verify_file(ca.string(), error);
  }
  if (error) return bad_file(ca, error, "no certificates in PEM");
  const std::string protocols = alpn_list();
  SSL_CTX_set_alpn_protos(context.native_handle(), reinterpret_cast<const unsigned char*>(protocols.data()),
                          static_cast<unsigned>(protocols.size()));
  return created;
}

std::unique_ptr<ByteStream> make_tls_stream(tcp::socket socket, std::shared_ptr<TlsContext> context) {
  return std::make_unique<TlsStream>(std::move(socket), std::move(context), std::string());
}

std::unique_ptr<ByteStream> make_tls_stream(tcp::socket socket, std::shared_ptr<TlsContext> context,
                                            const std::string& host) {
  assert(!host.empty());
  return std::make_unique<TlsStream>(std::move(socket), std::move(context), host);
}

}  // namespace selvage
