// SPDX-License-Identifier: MIT
//
// TLS 1.3 as a ByteStream, and the only door to OpenSSL's half of Asio. Both sides must agree on the protocol
// "selvage/1" (ALPN), so that neither can be talked into a conversation that was meant for another service.
//
//     auto context = tls_server_context({.certificate = "server.crt", .key = "server.key"});
//     auto stream = make_tls_stream(std::move(socket), *context);       // as the server
//     co_await stream->handshake();
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <boost/asio/ip/tcp.hpp>

#include "common/net/byte_stream.h"

namespace selvage {

inline constexpr std::string_view kAlpnProtocol = "selvage/1";

/// Keys, certificates and rules. Immutable and shared between streams and threads; a stream keeps the one it
/// began with, whatever is loaded after.
class TlsContext;

struct TlsServerFiles {
  std::filesystem::path certificate;  ///< PEM: the server's, then those between it and the authority
  std::filesystem::path key;          ///< PEM, without a pass phrase
};
/// NotFound, BadFile or InvalidArgument (the key is another certificate's) name the file.
Result<std::shared_ptr<TlsContext>> tls_server_context(const TlsServerFiles& files);

/// Trusts the authorities in the PEM file `ca`, or those of the system if it is empty.
Result<std::shared_ptr<TlsContext>> tls_client_context(const std::filesystem::path& ca);

/// The server's side of a connected socket; see make_tcp_stream for what is asked of it.
std::unique_ptr<ByteStream> make_tls_stream(asio::ip::tcp::socket socket,
                                            std::shared_ptr<TlsContext> context);

/// The client's side. The handshake fails with Unauthorised, and says why, unless the certificate is for
/// `host` (a name or an address) and comes from a trusted authority.
std::unique_ptr<ByteStream> make_tls_stream(asio::ip::tcp::socket socket, std::shared_ptr<TlsContext> context,
                                            const std::string& host);

}  // namespace selvage
