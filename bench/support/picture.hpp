// SPDX-License-Identifier: MIT
/// @file
/// A picture of spheres as SVG: shaded circles, coloured by speed, the far ones first.
#pragma once

#include <algorithm>  // std::max, std::min, std::nth_element, std::sort
#include <array>      // std::array
#include <cmath>      // std::ceil, std::cos, std::floor, std::sin
#include <cstddef>    // std::ptrdiff_t, std::size_t
#include <cstdint>    // std::int32_t, std::uint8_t
#include <cstdio>     // std::snprintf
#include <fstream>    // std::ofstream
#include <stdexcept>  // std::runtime_error
#include <string>     // std::string
#include <utility>    // std::pair
#include <vector>     // std::vector

namespace bench {

struct drawn_sphere {
    std::array<double, 3> x;  ///< 0 where there are fewer dimensions [m]
    double radius;            ///< [m]
    double speed;             ///< [m/s]
};
/// A line between two points, such as an edge of the box.
struct drawn_line {
    std::array<double, 3> from, to;
    bool is_wall;
};

/// Looks from above at an angle if it is three-dimensional, else at the plane.
class sphere_picture {
public:
    sphere_picture(std::string title, bool is_solid) : title_(std::move(title)), is_solid_(is_solid) {}

    void write(const std::string& path, const std::vector<drawn_sphere>& spheres,
               const std::vector<drawn_line>& lines) const {
        std::array<double, 4> frame{1e300, 1e300, -1e300, -1e300};  // of what is seen
        const auto widen = [&](const std::array<double, 3>& at, double r) {
            frame = {(std::min)(frame[0], at[0] - r), (std::min)(frame[1], at[1] - r), (std::max)(frame[2], at[0] + r),
                     (std::max)(frame[3], at[1] + r)};
        };
        std::vector<seen> all;
        for (const auto& one : spheres) {
            const auto at = look(one.x);
            all.push_back({at, one.radius, one.speed});
            widen(at, one.radius);
        }
        for (const auto& line : lines) widen(look(line.from), 0), widen(look(line.to), 0);
        if (all.empty() && lines.empty()) frame = {0, 0, 1, 1};
        const double width = (std::max)(frame[2] - frame[0], 1e-12);
        const double height = (std::max)(frame[3] - frame[1], 1e-12);
        const double scale = (std::min)(picture_width / width, picture_height / height);
        // x to the right, y up: as far as all is in the middle
        const auto place = [&](const std::array<double, 3>& at) {
            return std::pair(margin + (picture_width - scale * width) / 2 + scale * (at[0] - frame[0]),
                             margin + 34 + (picture_height - scale * height) / 2 + scale * (frame[3] - at[1]));
        };
        const double fastest = fast(all);
        std::sort(all.begin(), all.end(), [](const seen& a, const seen& b) { return a.at[2] > b.at[2]; });
        const auto hidden = find_hidden(all, frame, scale);

        std::ofstream out(path);
        const double total_width = picture_width + 2 * margin;
        const double total_height = picture_height + 2 * margin + 34 + 46;
        out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << number(total_width) << ' '
            << number(total_height) << "\" width=\"" << number(total_width) << "\" height=\"" << number(total_height)
            << "\" font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" "
               "fill=\"#ffffff\"/>\n"
            << "<defs>\n";
        for (std::size_t c = 0; c < shades; ++c) {
            const auto [r, g, b] = colour(static_cast<double>(c) / (shades - 1));
            out << "<radialGradient id=\"s" << c << "\" cx=\".38\" cy=\".34\" r=\".7\"><stop offset=\"0\" stop-color=\""
                << hex(r + (255 - r) * 0.65, g + (255 - g) * 0.65, b + (255 - b) * 0.65)
                << "\"/><stop offset=\".45\" stop-color=\"" << hex(r, g, b) << "\"/><stop offset=\"1\" stop-color=\""
                << hex(r * 0.45, g * 0.45, b * 0.45) << "\"/></radialGradient>\n";
        }
        out << "</defs>\n<text x=\"" << number(margin) << "\" y=\"" << number(margin + 12)
            << "\" font-size=\"15\" font-weight=\"bold\">" << escaped(title_) << "</text>\n";
        for (const auto& line : lines) {
            const auto [ax, ay] = place(look(line.from));
            const auto [bx, by] = place(look(line.to));
            out << "<line x1=\"" << number(ax) << "\" y1=\"" << number(ay) << "\" x2=\"" << number(bx) << "\" y2=\""
                << number(by) << "\" stroke=\"" << (line.is_wall ? "#5b4636" : "#b5bcc4") << "\" stroke-width=\""
                << (line.is_wall ? "2.5" : "1") << "\"/>\n";
        }
        for (std::size_t k = all.size(); k-- > 0;) {  // sorted from near to far; the far ones first
            if (hidden[k]) continue;
            const auto [x, y] = place(all[k].at);
            const double share = fastest > 0 ? (std::min)(all[k].speed / fastest, 1.0) : 0;
            out << "<circle cx=\"" << number(x) << "\" cy=\"" << number(y) << "\" r=\""
                << number((std::max)(scale * all[k].radius, 0.6)) << "\" fill=\"url(#s"
                << static_cast<int>(share * (shades - 1) + 0.5) << ")\"/>\n";
        }
        legend(out, fastest, picture_height + margin + 34 + 24);
        out << "</svg>\n";
        out.close();
        if (!out) throw std::runtime_error(path + ": cannot be written; is the disk full?");
    }

private:
    struct seen {
        std::array<double, 3> at;  // to the right, up, away
        double radius;
        double speed;
    };
    static constexpr double picture_width = 760;
    static constexpr double picture_height = 620;
    static constexpr double margin = 20;
    static constexpr std::size_t shades = 24;

    [[nodiscard]] std::array<double, 3> look(const std::array<double, 3>& x) const {
        if (!is_solid_) return {x[0], x[1], 0};
        constexpr double turned = 0.5;  // about z [rad]
        constexpr double raised = 0.35;
        const double right = std::cos(turned) * x[0] + std::sin(turned) * x[1];
        const double away = -std::sin(turned) * x[0] + std::cos(turned) * x[1];
        return {right, std::cos(raised) * x[2] + std::sin(raised) * away,
                std::cos(raised) * away - std::sin(raised) * x[2]};
    }
    /// Faster than nearly all; a few that are faster still have its colour.
    [[nodiscard]] static double fast(const std::vector<seen>& all) {
        std::vector<double> speeds;
        for (const auto& one : all) speeds.push_back(one.speed);
        if (speeds.empty()) return 0;
        const auto at = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(speeds.size() - 1));
        std::nth_element(speeds.begin(), speeds.begin() + at, speeds.end());
        return speeds[static_cast<std::size_t>(at)];
    }
    /// Spheres behind others need not be drawn: most of a bed. From the near ones on, covered squares are noted.
    [[nodiscard]] static std::vector<bool> find_hidden(const std::vector<seen>& all, const std::array<double, 4>& frame,
                                                       double scale) {
        std::vector<bool> hidden(all.size(), false);
        constexpr double pixel = 2;
        const auto columns = static_cast<std::int32_t>(std::ceil((frame[2] - frame[0]) * scale / pixel)) + 2;
        const auto rows = static_cast<std::int32_t>(std::ceil((frame[3] - frame[1]) * scale / pixel)) + 2;
        std::vector<std::uint8_t> covered(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
        for (std::size_t k = 0; k < all.size(); ++k) {
            const double x = (all[k].at[0] - frame[0]) * scale / pixel;
            const double y = (all[k].at[1] - frame[1]) * scale / pixel;
            const double r = all[k].radius * scale / pixel;
            if (r < 1) continue;  // dots
            bool is_seen = false;
            for (auto row = static_cast<std::int32_t>(y - r); row <= static_cast<std::int32_t>(y + r); ++row)
                for (auto column = static_cast<std::int32_t>(x - r); column <= static_cast<std::int32_t>(x + r);
                     ++column) {
                    if (row < 0 || column < 0 || row >= rows || column >= columns) continue;
                    const double dx = column + 0.5 - x;
                    const double dy = row + 0.5 - y;
                    if (dx * dx + dy * dy > r * r) continue;
                    auto& square = covered[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                                           static_cast<std::size_t>(column)];
                    if (square == 0) is_seen = true;
                    square = 1;
                }
            hidden[k] = !is_seen;
        }
        return hidden;
    }
    static void legend(std::ofstream& out, double fastest, double y) {
        for (std::size_t c = 0; c < shades; ++c) {
            const auto [r, g, b] = colour(static_cast<double>(c) / (shades - 1));
            out << "<rect x=\"" << number(margin + 8.0 * static_cast<double>(c)) << "\" y=\"" << number(y)
                << "\" width=\"8.5\" height=\"10\" fill=\"" << hex(r, g, b) << "\"/>\n";
        }
        char text[64];
        std::snprintf(text, sizeof text, "speed, 0 to %.3g m/s", fastest);
        out << "<text x=\"" << number(margin + 8.0 * shades + 10) << "\" y=\"" << number(y + 10) << "\">" << text
            << "</text>\n";
    }
    /// From dark blue over green to yellow, as bright as it is fast.
    [[nodiscard]] static std::array<double, 3> colour(double share) {
        constexpr double stops[5][3] = {{68, 60, 130}, {49, 104, 142}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}};
        const double at = share * 4;
        const auto k = static_cast<std::size_t>((std::min)(std::floor(at), 3.0));
        std::array<double, 3> mixed{};
        for (std::size_t c = 0; c < 3; ++c)
            mixed[c] = stops[k][c] + (stops[k + 1][c] - stops[k][c]) * (at - static_cast<double>(k));
        return mixed;
    }
    [[nodiscard]] static std::string hex(double r, double g, double b) {
        char text[16];
        std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(r), static_cast<unsigned>(g),
                      static_cast<unsigned>(b));
        return text;
    }
    [[nodiscard]] static std::string number(double value) {
        char text[32];
        std::snprintf(text, sizeof text, "%.2f", value);
        return text;
    }
    [[nodiscard]] static std::string escaped(const std::string& text) {
        std::string result;
        for (const char c : text) result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
        return result;
    }

    std::string title_;
    bool is_solid_;
};

}  // namespace bench
