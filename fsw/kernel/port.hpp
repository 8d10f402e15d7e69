// Ports: how a component reads what another wrote. Within one rate group an `In` is a const reference to
// the writer's `Out`; between rate groups (threads) it is bound to a crossing (crossing.hpp).
#pragma once

#include <string_view>

namespace omma {

class Crossing;

class OutputPort {
 public:
  OutputPort() = default;
  OutputPort(const OutputPort&) = delete;
  OutputPort& operator=(const OutputPort&) = delete;

  /// The crossing this is the far end of; null for a component's own output.
  virtual Crossing* as_crossing() const { return nullptr; }
  /// False while an output that must be led somewhere (a queue) is not.
  virtual bool bound() const { return true; }

 protected:
  ~OutputPort() = default;
};

class InputPort {
 public:
  /// The output this input reads; null while unbound.
  virtual const OutputPort* source() const = 0;
  /// True for an input that reads what its writer left in the tick before: the one way back (a prediction).
  /// Such a reader stands before its writer.
  virtual bool reads_previous_tick() const { return false; }

 protected:
  ~InputPort() = default;
};

/// Anything an `In` can be bound to: knows where the message to read now lies.
template <class Message>
class MessageSource : public OutputPort {
 public:
  const Message& current() const { return *current_; }

 protected:
  ~MessageSource() = default;
  void show(const Message& message) { current_ = &message; }

 private:
  const Message* current_ = nullptr;
};

/// Owned by the component that writes it. The message carries its own tick, time stamp and validity.
template <class Message>
class Out final : public MessageSource<Message> {
 public:
  Out() { this->show(message_); }
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
  /// To an output of a component that runs before this one in the same rate group, or to a crossing.
  void bind(const MessageSource<Message>& source) { source_ = &source; }
  const Message& operator*() const { return source_->current(); }
  const Message* operator->() const { return &source_->current(); }
  const OutputPort* source() const override { return source_; }

 private:
  const MessageSource<Message>* source_ = nullptr;
};

/// The way back: reads the message its writer left in the tick before. Declared as such so that the wiring
/// check wants the reader before the writer, and the graph draws it dotted.
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
