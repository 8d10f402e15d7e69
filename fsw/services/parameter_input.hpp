// A component's input for the parameters in force: tells it once of each commit.
#pragma once

#include "fsw/kernel/port.hpp"
#include "fsw/services/parameter.hpp"

namespace omma {

/// Left unbound the component keeps what it was built with.
class ParameterInput {
 public:
  void bind(const MessageSource<ParameterSet>& source) { input_.bind(source); }
  bool bound() const { return input_.source() != nullptr; }
  const In<ParameterSet>& port() const { return input_; }

  /// True once a commit, at the beginning of the first step that sees it.
  bool has_news() noexcept {
    if (!bound() || (seen_any_ && input_->number == seen_)) return false;
    seen_any_ = true;
    seen_ = input_->number;
    return true;
  }
  const ParameterSet* operator->() const { return &*input_; }
  const ParameterSet& operator*() const { return *input_; }

 private:
  In<ParameterSet> input_;
  std::uint32_t seen_ = 0;
  bool seen_any_ = false;
};

}  // namespace omma
