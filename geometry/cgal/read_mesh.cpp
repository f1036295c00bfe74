#include "geometry/src/files/read_mesh.h"
#include "geometry/cgal/guard.hpp"
#include "geometry/mem.h"
#include <CGAL/IO/Color.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/Simple_cartesian.h>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

using plain_point = CGAL::Simple_cartesian<double>::Point_3;

// CGAL's readers print their complaints to std::cerr even when not asked; they belong into the message.
struct captured_cerr {
    std::ostringstream text;
    std::streambuf *before = std::cerr.rdbuf(text.rdbuf());
    ~captured_cerr() { std::cerr.rdbuf(before); }
    std::string first_line() const { return text.str().substr(0, text.str().find('\n')); }
};

// CGAL makes room for as many vertices and faces as the header promises before it reads one.
static bool off_is_large_enough(std::ifstream &in)
{
    in.seekg(0, std::ios::end);
    const double bytes = static_cast<double>(in.tellg());
    in.seekg(0);
    double counts[2] = {0, 0};
    int found = 0;
    for (std::string word; found < 2 && in >> word;) {
        char *end = nullptr;
        const double number = std::strtod(word.c_str(), &end);
        if (word[0] == '#')
            std::getline(in, word);
        else if (*end == 0)
            counts[found++] = number;
        else if (word.find("OFF") == std::string::npos)
            break;
    }
    in.clear();
    in.seekg(0);
    return found == 2 && counts[0] <= bytes / 6 && counts[1] <= bytes / 4; // "0 0 0\n", "1 0\n"
}

bool read_mesh_polygons(const char *path, polygons *out, err *e)
{
    return guarded(e, path, [&] {
        std::ifstream in(path, std::ios::binary);
        if (!in) throw refusal(ERR_INPUT, "cannot be read: " + std::string(std::strerror(errno)));
        std::vector<plain_point> points;
        std::vector<std::vector<std::size_t>> faces;
        std::vector<CGAL::IO::Color> face_colours, colours;
        const std::string name = path;
        const bool off = name.size() > 4 && (name.back() == 'f' || name.back() == 'F');
        bool good = false;
        captured_cerr said;
        try {
            good = !off ? CGAL::IO::read_PLY(in, points, faces, face_colours, colours)
                        : off_is_large_enough(in) && CGAL::IO::read_OFF(in, points, faces);
        } catch (const std::bad_alloc &) { // sizes in a broken header
        } catch (const std::length_error &) {
        } catch (const CGAL::Failure_exception &) {
        }
        if (!good) {
            const std::string why = said.first_line();
            throw refusal(ERR_INPUT, std::string("is not a complete ") + (off ? "OFF" : "PLY") +
                                         " file of vertices and faces (" +
                                         (why.empty() ? "stopped at vertex " + std::to_string(points.size()) +
                                                            ", face " + std::to_string(faces.size())
                                                      : why) +
                                         ")");
        }
        std::size_t corners = 0;
        for (const auto &f : faces) corners += f.size();
        polygons p{};
        p.point_count = static_cast<int64_t>(points.size());
        p.polygon_count = static_cast<int64_t>(faces.size());
        p.xyz = NEW_ARRAY(double, 3 * points.size());
        p.first = NEW_ARRAY(int64_t, faces.size() + 1);
        p.corner = NEW_ARRAY(int64_t, corners);
        for (std::size_t v = 0; v < points.size(); v++)
            for (int c = 0; c < 3; c++) p.xyz[3 * v + c] = points[v][c];
        if (colours.size() == points.size() && !points.empty()) {
            p.rgb = NEW_ARRAY(uint8_t, 3 * points.size());
            for (std::size_t v = 0; v < points.size(); v++)
                for (std::size_t c = 0; c < 3; c++) p.rgb[3 * v + c] = colours[v][c];
        }
        for (std::size_t f = 0; f < faces.size(); f++) {
            int64_t at = p.first[f];
            for (std::size_t v : faces[f]) p.corner[at++] = static_cast<int64_t>(v);
            p.first[f + 1] = at;
        }
        *out = p;
        return true;
    });
}
