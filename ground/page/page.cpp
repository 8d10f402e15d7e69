#include "ground/page/page.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "fsw/kernel/input_error.hpp"
#include "ground/page/chart_style.hpp"

namespace omma::ground {
namespace {

constexpr std::string_view kStyle = R"(
*{box-sizing:border-box}body{margin:0;background:var(--paper);color:var(--ink);font:15px/1.45 system-ui,sans-serif}
main{max-width:1360px;margin:0 auto;padding:28px 24px 60px}h1{font-size:26px;margin:0}h2{font-size:18px;margin:34px 0 10px}
p.lead{color:var(--soft);margin:4px 0 20px}.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(200px,1fr));gap:12px}
.figure{background:var(--card);border:1px solid var(--line);border-radius:8px;padding:12px 14px}
.figure b{display:block;font-size:25px;font-weight:600;letter-spacing:-.01em}.figure span{color:var(--soft);font-size:13px}
.charts{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(340px,100%),1fr));gap:14px}
.charts svg,img{width:100%;background:var(--card);border:1px solid var(--line);border-radius:8px}.charts svg{padding:8px}
table{border-collapse:collapse;background:var(--card);border:1px solid var(--line);border-radius:8px}
table.wide{width:100%}td,th{padding:5px 14px;text-align:right;border-top:1px solid var(--line);font-variant-numeric:tabular-nums}
td:first-child,th:first-child{text-align:left}th{color:var(--soft);font-weight:500}figure{margin:0 0 18px}
figcaption{color:var(--soft);font-size:13px;margin-top:4px}.scroll{overflow-x:auto}.note{color:var(--soft);font-size:13px;max-width:90ch}
svg.zoomed{cursor:grab;touch-action:none}@media print{:root{--ink:#000;--soft:#444;--line:#bbb;--paper:#fff;--card:#fff;--a:#0b6bcb;--b:#c2570c;--c:#2e8b57;--out:#c81e3a}figure,svg,.figure,tr{break-inside:avoid}h2{break-after:avoid}
main{max-width:none;padding:0}body{font-size:10pt}.charts{grid-template-columns:1fr 1fr}.figures{grid-template-columns:repeat(4,1fr)}.figure b{font-size:15pt}
.scroll{overflow:visible}td,th{padding:3px 8px}img{max-height:180mm;object-fit:contain}}
@media(max-width:600px){main{padding:18px 12px 40px}td,th{padding:5px 6px}table{font-size:13px}.figures{grid-template-columns:1fr 1fr}.figure b{font-size:21px}}
)";

// Charts zoom: the wheel (or two clicks) zooms about the pointer, dragging moves, Escape shows all again.
constexpr std::string_view kZoom = R"(
document.querySelectorAll('.charts svg').forEach(s=>{const all=s.getAttribute('viewBox');let b=all.split(' ').map(Number),d=null;
const show=()=>{s.setAttribute('viewBox',b.join(' '));s.classList.toggle('zoomed',b.join(' ')!==all)};
const at=e=>{const r=s.getBoundingClientRect();return[b[0]+b[2]*(e.clientX-r.left)/r.width,b[1]+b[3]*(e.clientY-r.top)/r.height]};
const zoom=(e,k)=>{const a=all.split(' ').map(Number),p=at(e);if(b[2]*k>=a[2])b=a;else b=[p[0]-(p[0]-b[0])*k,p[1]-(p[1]-b[1])*k,b[2]*k,b[3]*k];show()};
s.addEventListener('wheel',e=>{if(!e.ctrlKey&&!s.classList.contains('zoomed')&&!e.shiftKey)return;e.preventDefault();zoom(e,e.deltaY>0?1.25:.8)},{passive:false});
s.addEventListener('dblclick',e=>zoom(e,.5));
s.addEventListener('pointerdown',e=>{if(s.classList.contains('zoomed'))d=at(e)});addEventListener('pointerup',()=>d=null);
s.addEventListener('pointermove',e=>{if(!d)return;const p=at(e);b[0]-=p[0]-d[0];b[1]-=p[1]-d[1];show()});
addEventListener('keydown',e=>{if(e.key==='Escape'){b=all.split(' ').map(Number);show()}})});
)";

std::string colour_variables(std::string_view PageColour::*shade) {
  std::string css = ":root{";
  for (const PageColour& colour : kPageColours)
    css += "--" + std::string(colour.name) + ":" + std::string(colour.*shade) + ";";
  return css + "}\n";
}

std::string style() {
  return colour_variables(&PageColour::light) + "@media(prefers-color-scheme:dark){" +
         colour_variables(&PageColour::dark) + "}" + std::string(kChartRules) + std::string(kStyle);
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(bytes.size() * 4 / 3 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t rest = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8U | (k < rest ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= rest ? kDigits[word >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

}  // namespace

std::string page_head(const std::string& title, const std::string& heading, const std::string& lead) {
  return "<!doctype html><html lang='en'><meta charset='utf-8'><meta name='viewport' "
         "content='width=device-width'><title>" +
         title + "</title><style>" + style() + "</style><main><h1>" + heading + "</h1><p class='lead'>" +
         lead + "</p>";
}

std::string page_end() {
  return "</main><script>" + std::string(kZoom) + "</script></html>\n";
}

std::string figure(const std::string& value, const std::string& text) {
  return "<div class='figure'><b>" + value + "</b><span>" + text + "</span></div>";
}

std::string figures_row(const std::string& figures) {
  return "<div class='figures'>" + figures + "</div>";
}

std::string table(const std::vector<std::string>& heads, const std::vector<std::vector<std::string>>& rows) {
  std::string html = "<div class='scroll'><table><tr>";
  for (const std::string& head : heads) html += "<th>" + head + "</th>";
  html += "</tr>";
  for (const std::vector<std::string>& row : rows) {
    html += "<tr>";
    for (const std::string& cell : row) html += "<td>" + cell + "</td>";
    html += "</tr>";
  }
  return html + "</table></div>";
}

std::string picture(std::span<const std::uint8_t> png, const std::string& caption) {
  return "<figure><img alt='" + caption + "' src='data:image/png;base64," + base64(png) + "'><figcaption>" +
         caption + "</figcaption></figure>";
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

void write_text_file(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (!out) throw InputError(path, 0, "output", "a file that can be written", "an error while writing");
}

void make_folder(const std::string& path, const std::string& option) {
  std::error_code failure;
  std::filesystem::create_directories(path, failure);
  if (failure) throw InputError(path, 0, option, "a folder that can be made", failure.message());
}

}  // namespace omma::ground
