// SPDX-License-Identifier: MIT
//
// Expected failure as a value. Bad input (a file, a stream, a message, an argument) never throws: the
// function that met it returns Result<T> with an Error that names the input, the place and the remedy.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace selvage {

/// Stable: these numbers travel in the protocol's Error message. Add at the end, never renumber.
enum class ErrorCode : std::uint16_t {
  InvalidArgument = 1,  ///< the caller asked for something that cannot be
  NotFound = 2,         ///< no such file, model, region
  BadFile = 3,          ///< a mesh, label or script file that is malformed
  BadStream = 4,        ///< a part or pack whose bytes are malformed or do not match their hash
  Unsupported = 5,      ///< well-formed, but newer or other than what this build reads
  LimitExceeded = 6,    ///< within the format, beyond a limit that protects this process
  Io = 7,               ///< the operating system said no
  Cancelled = 8,
  Protocol = 9,      ///< the peer broke the framing or the order of messages; closes the connection
  Unauthorised = 10,
  ModelChanged = 11,  ///< the pack behind a name is not the one that was opened
  Unavailable = 12,   ///< shutting down or overloaded; may be tried again
  Timeout = 13,
};

/// The enumerator's name, for logs and JSON.
std::string_view to_string(ErrorCode code);

struct Error {
  static constexpr std::uint64_t kNoOffset = ~std::uint64_t{0};

  ErrorCode code = ErrorCode::InvalidArgument;
  std::string message;               ///< one sentence a user can act on; names the input where known
  std::uint64_t offset = kNoOffset;  ///< byte offset in the input, where there is one

  /// The message as a user should see it, with the byte offset where there is one.
  std::string to_string() const;
};

template <class T>
using Result = tl::expected<T, Error>;

/// `return fail(ErrorCode::BadFile, "...")` from a function that returns any Result.
tl::unexpected<Error> fail(ErrorCode code, std::string message, std::uint64_t offset = Error::kNoOffset);

/// Hands a failed result's error on, optionally with the place it happened in front: "bunny.ply: ...".
template <class T>
tl::unexpected<Error> forward_error(Result<T>& failed, std::string_view context = {}) {
  Error error = std::move(failed.error());
  if (!context.empty()) error.message = std::string(context) + ": " + error.message;
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace selvage
