// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>

namespace selvage {

/// An array that is neither cleared when it is made nor given back between uses: whoever decodes region after
/// region finds its pages where they were.
template <class T>
class Scratch {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  /// Room for `count` of no particular value; what was there is lost.
  T* make(std::size_t count) {
    if (count > size_) {
      size_ = 0;
      data_.reset();
      data_ = allocate(count);
      size_ = count;
    }
    return data_.get();
  }

  /// Room for `count`, of which the first `kept` stay what they are.
  T* grow(std::size_t count, std::size_t kept) {
    if (count > size_) {
      Data larger = allocate(count);
      std::copy_n(data_.get(), kept, larger.get());
      data_ = std::move(larger);
      size_ = count;
    }
    return data_.get();
  }

  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }

 private:
  static constexpr std::align_val_t kCacheLine{64};
  struct Release {
    void operator()(T* data) const { ::operator delete(data, kCacheLine); }
  };
  using Data = std::unique_ptr<T[], Release>;
  static Data allocate(std::size_t count) {
    return Data(static_cast<T*>(::operator new(count * sizeof(T), kCacheLine)));
  }

  Data data_;
  std::size_t size_ = 0;
};

}  // namespace selvage
