// Fibres and the walk over all choices.
#include "tests/fsw/kernel/interleavings.hpp"

#include <ucontext.h>

#include <array>
#include <memory>

namespace omma::testing {
namespace {

class Model;
Model* running = nullptr;

/// One execution: follows the choices given, then always the first thread that can run.
class Model {
 public:
  Model(Execution execution, const std::vector<std::size_t>& choices)
      : execution_(std::move(execution)), given_(choices), fibres_(execution_.threads.size()) {}

  /// Number of threads that could run at each choice; the choices taken are in `taken`.
  std::vector<std::size_t> run() {
    running = this;
    for (std::size_t i = 0; i < fibres_.size(); ++i) prepare(i);
    std::vector<std::size_t> alternatives;
    for (std::vector<std::size_t> able = unfinished(); !able.empty(); able = unfinished()) {
      const std::size_t choice = taken.size() < given_.size() ? given_[taken.size()] : 0;
      alternatives.push_back(able.size());
      taken.push_back(choice);
      order += static_cast<char>('A' + able[choice]);
      current_ = able[choice];
      swapcontext(&home_, &fibres_[current_].context);
    }
    running = nullptr;
    return alternatives;
  }

  void step() { swapcontext(&fibres_[current_].context, &home_); }
  std::string verdict() const { return execution_.verdict(); }

  std::vector<std::size_t> taken;
  std::string order;

 private:
  struct Fibre {
    ucontext_t context{};
    std::unique_ptr<std::array<char, 64 * 1024>> stack = std::make_unique<std::array<char, 64 * 1024>>();
    bool finished = false;
  };

  void prepare(std::size_t index) {
    Fibre& fibre = fibres_[index];
    getcontext(&fibre.context);
    fibre.context.uc_stack.ss_sp = fibre.stack->data();
    fibre.context.uc_stack.ss_size = fibre.stack->size();
    fibre.context.uc_link = &home_;
    makecontext(&fibre.context, &Model::enter, 0);
  }

  static void enter() {
    Model& model = *running;
    const std::size_t self = model.current_;
    model.execution_.threads[self]();
    model.fibres_[self].finished = true;
  }

  std::vector<std::size_t> unfinished() const {
    std::vector<std::size_t> able;
    for (std::size_t i = 0; i < fibres_.size(); ++i)
      if (!fibres_[i].finished) able.push_back(i);
    return able;
  }

  Execution execution_;
  std::vector<std::size_t> given_;
  std::vector<Fibre> fibres_;
  ucontext_t home_{};
  std::size_t current_ = 0;
};

}  // namespace

void step_of_model() {
  if (running != nullptr) running->step();
}

Exploration explore(const std::function<Execution()>& make) {
  Exploration result;
  std::vector<std::size_t> choices;
  while (true) {
    Model model(make(), choices);
    const std::vector<std::size_t> alternatives = model.run();
    ++result.interleavings;
    const std::string fault = model.verdict();
    if (!fault.empty()) {
      result.fault = fault + " (threads in the order " + model.order + ")";
      return result;
    }
    choices = model.taken;
    while (!choices.empty() && choices.back() + 1 >= alternatives[choices.size() - 1]) choices.pop_back();
    if (choices.empty()) return result;
    ++choices.back();
  }
}

}  // namespace omma::testing
