// A vector with its capacity in the type and its storage inside: nothing is allocated, ever. Trivially
// copyable where its element is, so that it can cross a port by assignment (std::vector cannot, and
// boost::static_vector is not trivially copyable).
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace omma {

template <class T, std::size_t kCapacity>
class StaticVector {
 public:
  using value_type = T;

  static constexpr std::size_t capacity() { return kCapacity; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == kCapacity; }

  /// Appends; false (and nothing changed) when full.
  bool push_back(const T& value) {
    if (size_ == kCapacity) return false;
    items_[size_++] = value;
    return true;
  }
  void pop_back() { --size_; }
  void clear() { size_ = 0; }
  /// Shrinks, or grows with elements as they stand; more than the capacity becomes the capacity.
  void resize(std::size_t size) { size_ = size < kCapacity ? size : kCapacity; }

  T& operator[](std::size_t i) { return items_[i]; }
  const T& operator[](std::size_t i) const { return items_[i]; }
  T& back() { return items_[size_ - 1]; }
  const T& back() const { return items_[size_ - 1]; }
  T* data() { return items_.data(); }
  const T* data() const { return items_.data(); }
  T* begin() { return items_.data(); }
  T* end() { return items_.data() + size_; }
  const T* begin() const { return items_.data(); }
  const T* end() const { return items_.data() + size_; }

  operator std::span<const T>() const { return {items_.data(), size_}; }  // NOLINT: a view is no surprise

 private:
  std::array<T, kCapacity> items_{};
  std::size_t size_ = 0;
};

}  // namespace omma
