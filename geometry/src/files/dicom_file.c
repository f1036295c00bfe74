#include "geometry/dicom_file.h"
#include "geometry/src/files/temporary.h"
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>

extern char **environ;

/* Runs dcm2niix, whose talk is of no use, on the folder; its status, or -1 where it is not installed. */
static int convert(const char *folder, const char *into)
{
    char program[] = "dcm2niix", depth[] = "-d", none[] = "0", pack[] = "-z", no[] = "n", side[] = "-b", name[] = "-f",
         ct[] = "ct", to[] = "-o";
    char *arguments[] = {
        program, depth, none, pack, no, side, no, name, ct, to, (char *)(uintptr_t)into, (char *)(uintptr_t)folder,
        NULL};
    posix_spawn_file_actions_t quiet;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&quiet, 2, "/dev/null", O_WRONLY, 0);
    pid_t child;
    int status = posix_spawnp(&child, program, &quiet, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&quiet);
    if (status) return -1;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

static bool check_made(const char *folder, const dicom_series *series, const volume *v, err *e)
{
    double spacing =
        sqrt(v->step[2][0] * v->step[2][0] + v->step[2][1] * v->step[2][1] + v->step[2][2] * v->step[2][2]);
    return (v->size[2] == series->slices && fabs(spacing - series->spacing_mm) < 0.01) ||
           err_at(e, ERR_INPUT, folder, 0, NULL,
                  "dcm2niix made %d slices %.3f mm apart of the %d that lie %.3f mm apart", v->size[2], spacing,
                  series->slices, series->spacing_mm);
}

bool dicom_read(const char *folder, volume *out, err *e)
{
    const char *under = getenv("TMPDIR");
    char work[2048], path[2100];
    dicom_series series;
    volume v = {0};
    struct stat info;
    if (!dicom_check(folder, &series, e)) return false;
    snprintf(work, sizeof work, "%s/gnathos-dicom-XXXXXX", under && *under ? under : "/tmp");
    if (!mkdtemp(work)) return err_at(e, ERR_RESOURCE, work, 0, NULL, "cannot be made: %s", strerror(errno));
    int status = convert(folder, work);
    snprintf(path, sizeof path, "%s/ct.nii", work);
    bool good = true;
    if (status < 0)
        good = err_at(e, ERR_RESOURCE, folder, 0, NULL,
                      "dcm2niix is not installed, which reads DICOM here (Debian: apt install dcm2niix)");
    else if (stat(path, &info))
        good = err_at(e, ERR_INPUT, folder, 0, NULL, "dcm2niix made no volume of it (status %d)", status);
    good = good && volume_read(path, &v, e) && check_made(folder, &series, &v, e);
    temporary_remove(work);
    if (good)
        *out = v;
    else
        volume_free(&v);
    return good;
}
