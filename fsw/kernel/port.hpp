// Ports within one rate group: an `In` is a const reference to the writer's `Out`. Crossings between rate
// groups are in crossing.hpp.
#pragma once

#include <string_view>

namespace omma {

class OutputPort {
 public:
  OutputPort() = default;
  OutputPort(const OutputPort&) = delete;
  OutputPort& operator=(const OutputPort&) = delete;

 protected:
  ~OutputPort() = default;
};

class InputPort {
 public:
  /// The output this input reads; null while unbound.
  virtual const OutputPort* source() const = 0;
  /// True for an input that reads what its writer left in the tick before: the one way back (a prediction).
  /// Such a reader may stand before its writer.
  virtual bool reads_previous_tick() const { return false; }

 protected:
  ~InputPort() = default;
};

/// Owned by the component that writes it. The message carries its own tick, time stamp and validity.
template <class Message>
class Out final : public OutputPort {
 public:
  Message& operator*() { return message_; }
  const Message& operator*() const { return message_; }
  Message* operator->() { return &message_; }
  const Message* operator->() const { return &message_; }

 private:
  Message message_{};
};

/// Bound once, in the topology; reading an unbound input is prevented at start-up by the wiring check.
template <class Message>
class In final : public InputPort {
 public:
  void bind(const Out<Message>& out) { out_ = &out; }
  const Message& operator*() const { return **out_; }
  const Message* operator->() const { return out_->operator->(); }
  const OutputPort* source() const override { return out_; }

 private:
  const Out<Message>* out_ = nullptr;
};

/// The way back: reads the message its writer left in the tick before. Declared as such so that the wiring
/// check lets the reader stand before the writer, and the graph draws it dashed.
template <class Message>
class Previous final : public InputPort {
 public:
  void bind(const Out<Message>& out) { out_ = &out; }
  const Message& operator*() const { return **out_; }
  const Message* operator->() const { return out_->operator->(); }
  const OutputPort* source() const override { return out_; }
  bool reads_previous_tick() const override { return true; }

 private:
  const Out<Message>* out_ = nullptr;
};

}  // namespace omma
