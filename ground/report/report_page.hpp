// The report as one HTML page that needs nothing else, and as one JSON object.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ground/report/evaluation.hpp"
#include "ground/report/flight_log.hpp"

namespace omma::ground {

struct ReportPicture {
  std::string file;  ///< name of the PNG beside the page
  std::string caption;
  std::vector<std::uint8_t> png;
};

struct ReportContent {
  std::string spacecraft;
  Evaluation evaluation;
  std::vector<LoggedTime> times;  ///< empty where the log has none
  std::vector<ReportPicture> pictures;
};

/// Pictures are inside the page (base64), charts are SVG.
std::string report_page(const ReportContent& content);
std::string report_json(const ReportContent& content);
/// The figures in a few lines, for the terminal.
std::string report_text(const ReportContent& content);

}  // namespace omma::ground
