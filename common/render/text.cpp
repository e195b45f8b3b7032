// SPDX-License-Identifier: MIT
#include "common/render/text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace selvage {
namespace {

/// Glyphs from '!' to '~'. A glyph is polylines separated by spaces, a polyline is pairs of digits x y.
/// Baseline y = 2, small letters reach 6, capitals 8, descenders 0. A point stated twice is a dot.
constexpr std::array<std::string_view, 94> kGlyphs = {
    "0804 0202",                            // !
    "0806 2826",                            // "
    "1317 3337 0444 0646",                  // #
    "473818070615354443321203 2921",        // $
    "0248 0717180807 3242433332",           // %
    "420607182837360403122244",             // &
    "0806",                                 // '
    "19070311",                             // (
    "09171301",                             // )
    "2723 0644 0446",                       // *
    "2723 0545",                            // +
    "1301",                                 // ,
    "0535",                                 // -
    "0202",                                 // .
    "0148",                                 // /
    "180703123243473818",                   // 0
    "172822 1232",                          // 1
    "07183847460242",                       // 2
    "0718384746354443321203 1535",          // 3
    "32380444",                             // 4
    "480805354443321203",                   // 5
    "473818070312324344351504",             // 6
    "084812",                               // 7
    "180706153546473818 1504031232434435",  // 8
    "031232434738180706153546",             // 9
    "0202 0505",                            // :
    "0505 0301",                            // ;
    "370533",                               // <
    "0646 0444",                            // =
    "073503",                               // >
    "07183847462524 2222",                  // ?
    "433212030718384744242646",             // @
    "022842 1434",                          // A
    "02083847463505 3544433202",            // B
    "4738180703123243",                     // C
    "02082846442202",                       // D
    "48080242 0535",                        // E
    "480802 0535",                          // F
    "47381807031232434525",                 // G
    "0802 4842 0545",                       // H
    "0802",                                 // I
    "3833221203",                           // J
    "0802 4804 1542",                       // K
    "080242",                               // L
    "0208254842",                           // M
    "02084248",                             // N
    "180703123243473818",                   // O
    "02083847463505",                       // P
    "180703123243473818 2441",              // Q
    "02083847463505 2542",                  // R
    "473818070615354443321203",             // S
    "0848 2822",                            // T
    "080312324348",                         // U
    "082248",                               // V
    "0812263248",                           // W
    "0842 0248",                            // X
    "082548 2522",                          // Y
    "08480242",                             // Z
    "19090111",                             // [
    "0841",                                 // backslash
    "09191101",                             // ]
    "062846",                               // ^
    "0141",                                 // _
    "0817",                                 // `
    "16263532 341403122233",                // a
    "0802 0516263533221203",                // b
    "3526160503122233",                     // c
    "3832 3526160503122233",                // d
    "043435261605031232",                   // e
    "281712 0626",                          // f
    "36312000 3526160503122233",            // g
    "0802 0516263532",                      // h
    "0602 0808",                            // i
    "161100 1818",                          // j
    "0802 3604 1532",                       // k
    "080312",                               // l
    "0602 05162522 25364542",               // m
    "0602 0516263532",                      // n
    "160503122233352616",                   // o
    "0600 0516263533221203",                // p
    "3630 3526160503122233",                // q
    "0602 041626",                          // r
    "3616051424332202",                     // s
    "181322 0626",                          // t
    "0603122233 3632",                      // u
    "062246",                               // v
    "0612243246",                           // w
    "0632 0236",                            // x
    "0622 4610",                            // y
    "06360232",                             // z
    "29181605141221",                       // {
    "0901",                                 // |
    "09181625141201",                       // }
    "05162536",                             // ~
};
constexpr double kCapitalHeight = 6, kBaseline = 2, kGap = 1.6, kSpaceWidth = 2;  // in glyph units

std::string_view glyph_of(char c) { return c >= '!' && c <= '~' ? kGlyphs[c - '!'] : kGlyphs['?' - '!']; }

double width_of(char c) {
  if (c == ' ') return kSpaceWidth;
  double width = 0;
  bool is_x = true;
  for (char d : glyph_of(c)) {
    if (d == ' ') continue;
    if (is_x) width = std::max(width, double(d - '0'));
    is_x = !is_x;
  }
  return width;
}

double pen_of(const TextStyle& style) { return style.pen_px > 0 ? style.pen_px : style.height_px / 7; }

double distance_to_segment(double x, double y, double ax, double ay, double bx, double by) {
  const double dx = bx - ax, dy = by - ay, squared = dx * dx + dy * dy;
  const double along = squared > 0 ? std::clamp(((x - ax) * dx + (y - ay) * dy) / squared, 0.0, 1.0) : 0;
  return std::hypot(x - ax - along * dx, y - ay - along * dy);
}

/// How much of each pixel a pen has covered, in the pixels around a line of text.
class Coverage {
 public:
  Coverage(int left, int top, int width, int height)
      : left_(left),
        top_(top),
        width_(width),
        height_(height),
        share_(static_cast<std::size_t>(width) * height) {}

  void stroke(double ax, double ay, double bx, double by, double radius) {
    const double reach = radius + 1;
    const int x0 = clamped(std::min(ax, bx) - reach - left_, width_),
              x1 = clamped(std::max(ax, bx) + reach - left_, width_);
    const int y0 = clamped(std::min(ay, by) - reach - top_, height_),
              y1 = clamped(std::max(ay, by) + reach - top_, height_);
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const double d = distance_to_segment(left_ + x + 0.5, top_ + y + 0.5, ax, ay, bx, by);
        float& share = share_[static_cast<std::size_t>(y) * width_ + x];
        share = std::max(share, static_cast<float>(std::clamp(radius + 0.5 - d, 0.0, 1.0)));
      }
    }
  }

  void paint(Image& image, Rgb colour) const {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const float share = share_[static_cast<std::size_t>(y) * width_ + x];
        if (share > 0 && image.contains(left_ + x, top_ + y))
          blend(image.at(left_ + x, top_ + y), colour, share);
      }
  }

 private:
  static int clamped(double v, int size) { return static_cast<int>(std::clamp(v, 0.0, double(size))); }

  int left_, top_, width_, height_;
  std::vector<float> share_;
};

void stroke_glyph(Coverage& coverage, std::string_view glyph, double x, double y, double unit,
                  double radius) {
  bool pen_is_down = false;
  double from_x = 0, from_y = 0;
  for (std::size_t i = 0; i < glyph.size();) {
    if (glyph[i] == ' ') {
      pen_is_down = false;
      ++i;
      continue;
    }
    const double to_x = x + (glyph[i] - '0') * unit, to_y = y - (glyph[i + 1] - '0' - kBaseline) * unit;
    if (pen_is_down) coverage.stroke(from_x, from_y, to_x, to_y, radius);
    from_x = to_x, from_y = to_y;
    pen_is_down = true;
    i += 2;
  }
}

void draw_strokes(Image& image, double x, double y, std::string_view text, const TextStyle& style, double pen,
                  Rgb colour) {
  const double unit = style.height_px / kCapitalHeight, reach = pen + 3 * unit;
  const double width = text_width_px(text, style);
  Coverage coverage(static_cast<int>(std::floor(x - reach)),
                    static_cast<int>(std::floor(y - style.height_px - reach)),
                    static_cast<int>(std::ceil(width + 2 * reach)),
                    static_cast<int>(std::ceil(style.height_px + 2 * reach)));
  for (char c : text) {
    if (c != ' ') stroke_glyph(coverage, glyph_of(c), x, y, unit, pen / 2);
    x += (width_of(c) + kGap) * unit;
  }
  coverage.paint(image, colour);
}

}  // namespace

double text_width_px(std::string_view text, const TextStyle& style) {
  double units = 0;
  for (char c : text) units += width_of(c) + kGap;
  return std::max(0.0, units - kGap) * style.height_px / kCapitalHeight;
}

void draw_text(Image& image, double x, double y, std::string_view text, const TextStyle& style) {
  const double pen = pen_of(style);
  if (style.halo_px > 0) draw_strokes(image, x, y, text, style, pen + 2 * style.halo_px, style.halo_colour);
  draw_strokes(image, x, y, text, style, pen, style.colour);
}

void draw_text_centred(Image& image, double x, double y, std::string_view text, const TextStyle& style) {
  draw_text(image, x - text_width_px(text, style) / 2, y + style.height_px / 2, text, style);
}

}  // namespace selvage
