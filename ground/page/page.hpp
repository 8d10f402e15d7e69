// Parts of a self-contained HTML page: style, headline figures, tables and pictures. Everything is inside the
// page; it opens without a network, on a phone and on paper, and its charts can be zoomed.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ground/format.hpp"  // pages are made of formatted numbers

namespace omma::ground {

/// The beginning of a page up to and with its heading; `lead` is a sentence below it (HTML).
std::string page_head(const std::string& title, const std::string& heading, const std::string& lead);
std::string page_end();

/// One large number and what it says (both HTML); a row of them stands in figures_row.
std::string figure(const std::string& value, const std::string& text);
std::string figures_row(const std::string& figures);

/// A table; cells are HTML, the first column is text, the others numbers.
std::string table(const std::vector<std::string>& heads, const std::vector<std::vector<std::string>>& rows);

/// A picture inside the page with its caption below.
std::string picture(std::span<const std::uint8_t> png, const std::string& caption);

/// Text with the characters that HTML reserves replaced.
std::string escaped(const std::string& text);

/// @throws InputError naming the path when it cannot be written
void write_text_file(const std::string& path, const std::string& text);
/// Makes the folder. @throws InputError naming `option` when it cannot be made
void make_folder(const std::string& path, const std::string& option);

}  // namespace omma::ground
