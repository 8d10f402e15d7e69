// A FITS file as cfitsio knows it, for files that are made at start-up or on the ground.
#pragma once

#include <fitsio.h>

#include <array>
#include <string>
#include <string_view>

#include "fsw/kernel/input_error.hpp"

namespace omma {

// A FITS file that is closed again whatever happens; every refusal of the library becomes an InputError.
class FitsFile {
 public:
  explicit FitsFile(std::string name) : name_(std::move(name)) {}
  ~FitsFile() {
    int status = 0;
    if (fits_ != nullptr) fits_close_file(fits_, &status);
    fits_clear_errmsg();
  }
  FitsFile(const FitsFile&) = delete;
  FitsFile& operator=(const FitsFile&) = delete;

  void create() {
    call([&](int* status) { fits_create_diskfile(&fits_, name_.c_str(), status); },
         "a file that can be written");
  }
  void open() {
    call([&](int* status) { fits_open_diskfile(&fits_, name_.c_str(), READONLY, status); }, "a FITS file");
  }
  void close() {
    call(
        [&](int* status) {
          fits_close_file(fits_, status);
          fits_ = nullptr;
        },
        "a file that can be written");
  }
  /// Runs one call of the library; `expected` is for the message where it fails.
  template <class Call>
  void call(Call&& library, const char* expected) const {
    int status = 0;
    library(&status);
    if (status == 0) return;
    std::array<char, FLEN_STATUS> text{};
    fits_get_errstatus(status, text.data());
    fits_clear_errmsg();
    throw error("FITS", expected, text.data());
  }
  InputError error(const char* field, std::string_view expected, std::string_view found) const {
    return {name_, 0, field, expected, found};
  }
  fitsfile* get() const { return fits_; }

 private:
  std::string name_;
  fitsfile* fits_ = nullptr;
};

}  // namespace omma
