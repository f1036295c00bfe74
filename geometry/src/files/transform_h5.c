/* Transforms as ITK writes .h5. The one file that includes HDF5, which is asked in a process of its own: version 1.10
 * ends the process on files that are not sound, or reads without an end. */
#include "geometry/input_file.h"
#include "geometry/src/files/stored_transform.h"
#include <hdf5.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FILE_MOST = 1 << 20, SECONDS_MOST = 2 };

typedef struct answer {
    bool good;
    stored_transform stored;
    err why;
} answer;

static bool read_type(hid_t file, const char *path, stored_transform *s, err *e)
{
    char name[256] = "", *long_name = NULL;
    hid_t set = H5Dopen2(file, "/TransformGroup/0/TransformType", H5P_DEFAULT);
    hid_t type = set >= 0 ? H5Dget_type(set) : -1, space = set >= 0 ? H5Dget_space(set) : -1;
    bool text = type >= 0 && H5Tget_class(type) == H5T_STRING && H5Sget_simple_extent_npoints(space) == 1, good = false;
    if (text && H5Tis_variable_str(type) > 0) {
        hid_t memory = H5Tcopy(H5T_C_S1);
        H5Tset_size(memory, H5T_VARIABLE);
        good = H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, &long_name) >= 0 && long_name;
        if (good) strncat(name, long_name, sizeof name - 1);
    } else if (text && H5Tget_size(type) < sizeof name) {
        good = H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, name) >= 0;
    }
    if (!good) return err_at(e, ERR_INPUT, path, 0, NULL, "is not a transform of ITK: TransformType is missing");
    return stored_transform_type(s, name, path, 0, e);
}

/* One list of numbers under its name, or as releases of ITK before 5 spell it. */
static bool read_numbers(hid_t file, const char *path, const char *name, const char *old, double *out, int *count,
                         err *e)
{
    hid_t set = H5Lexists(file, name, H5P_DEFAULT) > 0  ? H5Dopen2(file, name, H5P_DEFAULT)
                : H5Lexists(file, old, H5P_DEFAULT) > 0 ? H5Dopen2(file, old, H5P_DEFAULT)
                                                        : -1;
    hid_t space = set >= 0 ? H5Dget_space(set) : -1;
    hssize_t n = space >= 0 ? H5Sget_simple_extent_npoints(space) : -1;
    if (n < 0) return err_at(e, ERR_INPUT, path, 0, name, "missing");
    if (n > STORED_NUMBERS_MOST)
        return err_at(e, ERR_INPUT, path, 0, name, "has %lld numbers, more than a rigid transform", (long long)n);
    if (H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out) < 0)
        return err_at(e, ERR_INPUT, path, 0, name, "cannot be read");
    *count = (int)n;
    return true;
}

static bool ask(const char *path, stored_transform *s, err *e)
{
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) return err_at(e, ERR_INPUT, path, 0, NULL, "is not an HDF5 file");
    if (H5Lexists(file, "/TransformGroup", H5P_DEFAULT) <= 0 || H5Lexists(file, "/TransformGroup/0", H5P_DEFAULT) <= 0)
        return err_at(e, ERR_INPUT, path, 0, NULL, "is not a transform of ITK: TransformGroup is missing");
    if (!read_type(file, path, s, e)) return false;
    if (H5Lexists(file, "/TransformGroup/1", H5P_DEFAULT) > 0)
        return err_at(e, ERR_INPUT, path, 0, NULL, "a second transform; one per file is read");
    return read_numbers(file, path, "/TransformGroup/0/TransformParameters", "/TransformGroup/0/TranformParameters",
                        s->parameter, &s->parameter_count, e) &&
           read_numbers(file, path, "/TransformGroup/0/TransformFixedParameters",
                        "/TransformGroup/0/TranformFixedParameters", s->fixed, &s->fixed_count, e);
}

static _Noreturn void answer_apart(const char *path, int to)
{
    struct rlimit no_core = {0, 0}, time = {SECONDS_MOST, SECONDS_MOST + 1};
    answer a = {.stored = stored_transform_new()};
    setrlimit(RLIMIT_CORE, &no_core);
    setrlimit(RLIMIT_CPU, &time);
    H5dont_atexit();
    a.good = ask(path, &a.stored, &a.why);
    _exit(write(to, &a, sizeof a) == (ssize_t)sizeof a ? 0 : 1);
}

bool read_transform_h5(const char *path, stored_transform *out, err *e)
{
    int way[2];
    answer a;
    size_t have = 0;
    if (!input_file_check(path, FILE_MOST, e)) return false;
    if (pipe(way)) return err_at(e, ERR_RESOURCE, path, 0, NULL, "cannot be read: no pipe");
    pid_t child = fork();
    if (child == 0) answer_apart(path, way[1]);
    close(way[1]);
    for (ssize_t n = 1; child > 0 && have < sizeof a && n > 0; have += n > 0 ? (size_t)n : 0)
        n = read(way[0], (char *)&a + have, sizeof a - have);
    close(way[0]);
    if (child < 0) return err_at(e, ERR_RESOURCE, path, 0, NULL, "cannot be read: no process");
    waitpid(child, NULL, 0);
    if (have < sizeof a) return err_at(e, ERR_INPUT, path, 0, NULL, "is not a sound HDF5 file");
    if (!a.good) return err_set(e, a.why.code, "%s", a.why.text);
    *out = a.stored;
    return true;
}
