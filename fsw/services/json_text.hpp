// JSON as text, for what the flight program prints about itself: commas and quotes in the right places.
#pragma once

#include <string>
#include <string_view>

namespace omma {

class JsonText {
 public:
  JsonText& open_object() { return open('{'); }
  JsonText& close_object() { return close('}'); }
  JsonText& open_array() { return open('['); }
  JsonText& close_array() { return close(']'); }
  /// Inside an object: the name of the value that follows.
  JsonText& key(std::string_view name) {
    string(name);
    text_ += ':';
    fresh_ = true;
    return *this;
  }
  JsonText& string(std::string_view value);
  JsonText& number(double value);
  JsonText& boolean(bool value) { return raw(value ? "true" : "false"); }

  const std::string& text() const { return text_; }

 private:
  JsonText& open(char bracket) {
    separate();
    text_ += bracket;
    fresh_ = true;
    return *this;
  }
  JsonText& close(char bracket) {
    text_ += bracket;
    fresh_ = false;
    return *this;
  }
  JsonText& raw(std::string_view value) {
    separate();
    text_ += value;
    return *this;
  }
  void separate() {
    if (!fresh_) text_ += ',';
    fresh_ = false;
  }

  std::string text_;
  bool fresh_ = true;  // nothing to separate from
};

}  // namespace omma
