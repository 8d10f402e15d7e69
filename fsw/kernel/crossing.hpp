// Crossings: how a message goes from one rate group (thread) to another without either waiting. A crossing is
// named in the topology, so that a reader sees where threads meet:
//
//   Latest<AttitudeEstimate> attitude_for_motion{attitude.estimate};   // newest value wins
//   motion.attitude.bind(attitude_for_motion);
//
//   Queue<Detection, 64> detections_to_log;                            // every message, in order
//   detector.found.bind(detections_to_log);
//   log.detections.bind(detections_to_log);
//
// The scheduler moves the values: out right after the writing component's step, in at the start of the
// reading group's beat. The components know nothing of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fsw/kernel/port.hpp"
#include "fsw/kernel/spsc_queue.hpp"
#include "fsw/kernel/triple_buffer.hpp"

namespace omma {

class Crossing {
 public:
  /// The component's output that is led across; null while unbound.
  virtual const OutputPort* writer() const = 0;
  /// "latest" or "queue", for the drawing.
  virtual std::string_view kind() const = 0;
  /// On the writer's thread, after the writer's step.
  virtual void publish() noexcept {}
  /// On the reader's thread, before the first step of its beat.
  virtual void acquire() noexcept {}

 protected:
  ~Crossing() = default;
};

/// The newest value, for any number of inputs of ONE rate group. Costs the writer one copy, the reader none.
template <class Message>
class Latest final : public MessageSource<Message>, public Crossing {
 public:
  explicit Latest(const Out<Message>& writer) : writer_(&writer) { this->show(buffer_.front()); }
  Crossing* as_crossing() const override { return self_; }
  const OutputPort* writer() const override { return writer_; }
  std::string_view kind() const override { return "latest"; }
  void publish() noexcept override {
    buffer_.back() = **writer_;
    buffer_.publish();
  }
  void acquire() noexcept override {
    if (buffer_.acquire()) this->show(buffer_.front());
  }

 private:
  TripleBuffer<Message> buffer_;
  const Out<Message>* writer_;
  Crossing* self_ = this;  // inputs hold it const; the scheduler, which finds it through them, moves it
};

/// The storage between an OutQueue and an InQueue, without its capacity.
template <class Message>
class MessageQueue : public OutputPort, public Crossing {
 public:
  virtual bool push(const Message& message) noexcept = 0;
  virtual bool pop(Message& message) noexcept = 0;
  /// Messages that found the queue full.
  virtual std::uint64_t dropped() const noexcept = 0;
  Crossing* as_crossing() const override { return self_; }
  const OutputPort* writer() const override { return writer_; }
  std::string_view kind() const override { return "queue"; }
  void set_writer(const OutputPort& writer) { writer_ = &writer; }

 protected:
  ~MessageQueue() = default;

 private:
  const OutputPort* writer_ = nullptr;
  Crossing* self_ = this;
};

/// Every message in order, from one OutQueue to one InQueue; works within a group and between groups.
template <class Message, std::size_t kCapacity>
class Queue final : public MessageQueue<Message> {
 public:
  bool push(const Message& message) noexcept override { return ring_.push(message); }
  bool pop(Message& message) noexcept override { return ring_.pop(message); }
  std::uint64_t dropped() const noexcept override { return ring_.dropped(); }

 private:
  SpscQueue<Message, kCapacity> ring_;
};

/// A component's end of a queue that it writes.
template <class Message>
class OutQueue final : public OutputPort {
 public:
  void bind(MessageQueue<Message>& queue) {
    queue_ = &queue;
    queue.set_writer(*this);
  }
  /// False when the queue is full: the message is dropped and counted.
  bool send(const Message& message) noexcept { return queue_->push(message); }
  bool bound() const override { return queue_ != nullptr; }

 private:
  MessageQueue<Message>* queue_ = nullptr;
};

/// A component's end of a queue that it reads.
template <class Message>
class InQueue final : public InputPort {
 public:
  void bind(MessageQueue<Message>& queue) { queue_ = &queue; }
  /// Takes the oldest message; false when there is none.
  bool receive(Message& message) noexcept { return queue_->pop(message); }
  const OutputPort* source() const override { return queue_; }

 private:
  MessageQueue<Message>* queue_ = nullptr;
};

}  // namespace omma
