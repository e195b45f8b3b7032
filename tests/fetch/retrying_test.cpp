// SPDX-License-Identifier: MIT
#include "client/fetch/retrying.h"

#include <gtest/gtest.h>

namespace selvage {
namespace {

using std::chrono::milliseconds;

const Error kLost{ErrorCode::Io, "the connection was lost"};

TEST(Retrying, GivesUpOnWhatWillNotPass) {
  Retrying retrying(RetryPolicy{});
  for (const ErrorCode code : {ErrorCode::NotFound, ErrorCode::Unauthorised, ErrorCode::BadStream,
                               ErrorCode::Cancelled, ErrorCode::Protocol}) {
    EXPECT_FALSE(retrying.try_again({code, "no"}, {}));
  }
}

TEST(Retrying, TellsOfEveryPauseAndLosesPatience) {
  int told = 0;
  milliseconds waited{0};
  Retrying retrying({.first_delay = milliseconds(1), .give_up_after = milliseconds(40)},
                    [&](const Error& error, milliseconds delay) {
                      ++told;
                      waited += delay;
                      EXPECT_EQ(error.message, kLost.message);
                    });
  int tries = 0;
  while (retrying.try_again(kLost, {})) ++tries;
  EXPECT_GE(tries, 1);
  EXPECT_EQ(told, tries);
  EXPECT_LE(waited, milliseconds(40));
}

TEST(Retrying, ProgressRestoresItsPatience) {
  Retrying retrying({.first_delay = milliseconds(1), .give_up_after = milliseconds(4)});
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(retrying.try_again(kLost, {}));
    retrying.note_progress();
  }
}

TEST(Retrying, AStopEndsAPause) {
  std::stop_source source;
  Retrying retrying({.first_delay = std::chrono::hours(1),
                     .longest_delay = std::chrono::hours(1),
                     .give_up_after = std::chrono::hours(2)},
                    [&](const Error&, milliseconds) { source.request_stop(); });
  EXPECT_FALSE(retrying.try_again(kLost, source.get_token()));
}

}  // namespace
}  // namespace selvage
