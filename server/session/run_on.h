// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <type_traits>
#include <utility>

#include <boost/asio/associated_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/use_awaitable.hpp>

namespace selvage {

/// What `work()` returns when run on `workers`. The coroutine itself never leaves its strand: resuming it
/// elsewhere would race with whoever cancels it. It cannot be cancelled in between, so `work` may refer to
/// what the coroutine keeps.
template <class Work, class Value = std::invoke_result_t<Work>>
boost::asio::awaitable<Value> run_on(boost::asio::any_io_executor workers, Work work) {
  namespace asio = boost::asio;
  auto initiate = [workers](auto done, Work job) {
    auto home = asio::make_work_guard(asio::get_associated_executor(done));
    auto run = [done = std::move(done), job = std::move(job), home = std::move(home)]() mutable {
      std::exception_ptr thrown;
      Value value{};
      try {
        value = job();
      } catch (...) {
        thrown = std::current_exception();
      }
      const auto executor = home.get_executor();
      auto finish = [done = std::move(done), home = std::move(home), thrown,
                     value = std::move(value)]() mutable { std::move(done)(thrown, std::move(value)); };
      asio::post(executor, std::move(finish));
    };
    asio::post(workers, std::move(run));
  };
  const asio::use_awaitable_t<> token;
  co_return co_await asio::async_initiate<const asio::use_awaitable_t<>, void(std::exception_ptr, Value)>(
      std::move(initiate), token, std::move(work));
}

}  // namespace selvage
