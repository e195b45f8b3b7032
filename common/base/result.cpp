// SPDX-License-Identifier: MIT
#include "common/base/result.h"

namespace selvage {

std::string_view to_string(ErrorCode code) {
  switch (code) {
    case ErrorCode::InvalidArgument: return "InvalidArgument";
    case ErrorCode::NotFound: return "NotFound";
    case ErrorCode::BadFile: return "BadFile";
    case ErrorCode::BadStream: return "BadStream";
    case ErrorCode::Unsupported: return "Unsupported";
    case ErrorCode::LimitExceeded: return "LimitExceeded";
    case ErrorCode::Io: return "Io";
    case ErrorCode::Cancelled: return "Cancelled";
    case ErrorCode::Protocol: return "Protocol";
    case ErrorCode::Unauthorised: return "Unauthorised";
    case ErrorCode::ModelChanged: return "ModelChanged";
    case ErrorCode::Unavailable: return "Unavailable";
    case ErrorCode::Timeout: return "Timeout";
  }
  return "Unknown";
}

std::string Error::to_string() const {
  if (offset == kNoOffset) return message;
  return message + " (at byte " + std::to_string(offset) + ")";
}

tl::unexpected<Error> fail(ErrorCode code, std::string message, std::uint64_t offset) {
  return tl::unexpected<Error>(Error{code, std::move(message), offset});
}

}  // namespace selvage
