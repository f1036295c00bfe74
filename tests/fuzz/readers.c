#include "tests/fuzz/readers.h"
#include "app/planner/plan/plan_file.h"
#include "app/planner/predict/outcome_read.h"
#include "geometry/dicom_file.h"
#include "geometry/mesh_file.h"
#include "geometry/plane_file.h"
#include "geometry/transform_file.h"
#include "geometry/volume_file.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#if GNATHOS_WITH_CGAL
#include "app/planner/store/journal.h"
#include "app/planner/store/pack_file.h"
#endif

static char folder[256];
static case_file base; /* of the plans */

static void remove_folder(void)
{
    static const char *const beside[] = {"skin.off", "skull.off", "mandible.off", "landmarks.mrk.json"};
    char path[512];
    for (size_t i = 0; i < sizeof beside / sizeof *beside; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, beside[i]);
        unlink(path);
    }
    for (int i = 0; i < reader_count; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, readers[i].file);
        unlink(path);
    }
    snprintf(path, sizeof path, "%s/slices/second.dcm", folder);
    unlink(path);
    snprintf(path, sizeof path, "%s/slices", folder);
    rmdir(path);
    rmdir(folder);
}

static void link_as(const char *there, const char *name)
{
    char here[512];
    snprintf(here, sizeof here, "%s/%s", folder, name);
    if (symlink(there, here)) abort();
}

/* A folder of slices, of which one is there. */
static void make_slices(void)
{
    char path[512];
    snprintf(path, sizeof path, "%s/slices", folder);
    if (mkdir(path, 0700)) abort();
    link_as(FUZZ_SLICE, "slices/second.dcm");
}

void reader_prepare(void)
{
    const char *under = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%s/gnathos-readers-XXXXXX", under && *under ? under : "/tmp");
    if (!mkdtemp(folder)) abort();
    atexit(remove_folder);
    link_as(FUZZ_BASE "/skin.off", "skin.off");
    link_as(FUZZ_BASE "/skull.off", "skull.off");
    link_as(FUZZ_BASE "/mandible.off", "mandible.off");
    link_as(FUZZ_BASE "/landmarks.mrk.json", "landmarks.mrk.json");
    make_slices();
    err e = {0};
    base = case_file_default();
    if (GNATHOS_WITH_CGAL && !case_file_load(FUZZ_BASE, &base, &e)) abort();
}

/* What a refusal must be: a code, and one line of text. */
static bool refused(const err *e)
{
    assert(e->code != ERR_NONE && e->code != ERR_INTERNAL);
    assert(*e->text && !strchr(e->text, '\n'));
    return false;
}

static bool with_issues(bool accepted, issue_list *issues)
{
    err e = {0};
    assert(accepted == issue_none_is_error(issues, &e));
    if (!accepted) refused(&e);
    for (int i = 0; i < issues->count; i++) assert(issues->item[i].text && *issues->item[i].text);
    issue_list_free(issues);
    return accepted;
}

static bool read_case(const char *path)
{
    issue_list issues = {0};
    case_file c;
    return with_issues(case_file_read(path, &c, &issues), &issues);
}

static bool read_plan(const char *path)
{
    issue_list issues = {0};
    plan_file p;
    return with_issues(plan_file_read(path, &base, &p, &issues), &issues);
}

static bool read_landmarks(const char *path)
{
    err e = {0};
    landmarks l = {0};
    if (!landmarks_read(path, &l, NULL, &e)) return refused(&e);
    assert(l.count > 0);
    for (int32_t i = 0; i < l.count; i++) {
        assert(*l.point[i].label && landmarks_find(&l, l.point[i].label) == &l.point[i]);
        for (int k = 0; k < 3; k++) assert(isfinite(l.point[i].xyz[k]));
    }
    landmarks_free(&l);
    return true;
}

static bool read_planes(const char *path)
{
    err e = {0};
    cut_plane *planes = NULL;
    int count = 0;
    if (!planes_read(path, &planes, &count, &e)) return refused(&e);
    for (int i = 0; i < count; i++) {
        double square = 0;
        for (int k = 0; k < 3; k++) square += planes[i].normal[k] * planes[i].normal[k];
        assert(*planes[i].label && fabs(square - 1) < 1e-9);
    }
    free(planes);
    return true;
}

static bool read_transform(const char *path)
{
    err e = {0};
    rigid a, again;
    double m[16];
    if (!transform_read(path, &a, &e)) return refused(&e);
    rigid_to_matrix(&a, m);
    for (int i = 0; i < 16; i++) assert(isfinite(m[i]));
    bool rigid_still = rigid_from_matrix(m, &again, &e);
    assert(rigid_still);
    return true;
}

static bool read_surface(const char *path)
{
    err e = {0};
    surface s = {0};
    if (!mesh_read_surface(path, MESH_SPACE_FROM_FILE, &s, NULL, &e)) return refused(&e);
    bool whole = surface_check(&s, &e);
    assert(whole && s.triangle_count > 0);
    surface_free(&s);
    return true;
}

static bool read_volume(const char *path)
{
    err e = {0};
    volume v = {0};
    if (!volume_read(path, &v, &e)) return refused(&e);
    int64_t sum = 0;
    size_t voxels = (size_t)v.layers * (size_t)v.size[0] * (size_t)v.size[1] * (size_t)v.size[2];
    for (size_t i = 0; i < voxels; i++) sum += v.value[i];
    assert(voxels > 0 && llabs(sum) <= INT64_C(32768) * (int64_t)voxels);
    for (int32_t i = 0; i < v.segment_count; i++)
        assert(v.segment[i].layer >= 0 && v.segment[i].layer < v.layers && *v.segment[i].name);
    volume_free(&v);
    return true;
}

static bool read_slice(const char *path)
{
    (void)path; /* beside the second one */
    char slices[512];
    err e = {0};
    dicom_series s;
    snprintf(slices, sizeof slices, "%s/slices", folder);
    if (!dicom_check(slices, &s, &e)) return refused(&e);
    assert(s.slices == 2 && isfinite(s.spacing_mm) && s.spacing_mm > 0);
    return true;
}

static bool read_outcome(const char *path)
{
    (void)path; /* outcome.json of the folder */
    err e = {0};
    outcome_record r = {0};
    if (!outcome_record_read(folder, &r, &e)) return refused(&e);
    assert(r.before.count > 0 && r.before.count == r.after.count);
    outcome_record_free(&r);
    return true;
}

#if GNATHOS_WITH_CGAL
static bool read_pack(const char *path)
{
    err e = {0};
    pack_file p = {0};
    if (!pack_read(path, &p, &e)) return refused(&e);
    for (int i = 0; i < p.count; i++) {
        size_t count;
        uint8_t *bytes = pack_take(&p, p.entry[i].name, 1, &count);
        free(bytes);
    }
    pack_free(&p);
    return true;
}

static bool take_record(uint32_t kind, const void *bytes, size_t size, void *context, err *e)
{
    uint8_t *sum = context;
    for (size_t i = 0; i < size; i++) *sum ^= ((const uint8_t *)bytes)[i];
    return kind != 666 || err_set(e, ERR_INPUT, "not this kind");
}

static bool read_journal(const char *path)
{
    err e = {0};
    journal j = {0};
    uint8_t sum = 0;
    static const char key[HASH_TEXT_SIZE] = "aaaa";
    if (!journal_open(path, key, false, take_record, &sum, &j, &e)) return refused(&e);
    int64_t before = j.record_count;
    bool added = journal_add(&j, 1, "more", 4, &e);
    assert(added && j.record_count == before + 1);
    journal_close(&j);
    return true;
}
#endif

static const char ply_header[] =
    "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n";

const reader readers[] = {
    {"case", "case.json", read_case, NULL},
    {"plan", "plan.json", read_plan, NULL},
    {"markups", "points.mrk.json", read_landmarks, NULL},
    {"fcsv", "points.fcsv", read_landmarks, NULL},
    {"planes", "planes.mrk.json", read_planes, NULL},
    {"tfm", "move.tfm", read_transform, NULL},
    {"mat", "move.mat", read_transform, NULL},
    {"h5", "move.h5", read_transform, NULL},
    {"ply", "mesh.ply", read_surface, NULL},
    {"ply_body", "body.ply", read_surface, ply_header},
    {"off", "mesh.off", read_surface, NULL},
    {"vtk", "mesh.vtk", read_surface, NULL},
    {"vtp", "mesh.vtp", read_surface, NULL},
    {"stl", "mesh.stl", read_surface, NULL},
    {"obj", "mesh.obj", read_surface, NULL},
    {"gltf", "mesh.gltf", read_surface, NULL},
    {"glb", "mesh.glb", read_surface, NULL},
    {"nrrd", "volume.nrrd", read_volume, NULL},
    {"nifti", "volume.nii", read_volume, NULL},
    {"mha", "volume.mha", read_volume, NULL},
    {"dicom", "slices/first.dcm", read_slice, NULL},
    {"outcome", "outcome.json", read_outcome, NULL},
#if GNATHOS_WITH_CGAL
    {"pack", "prepared.pack", read_pack, NULL},
    {"journal", "run.journal", read_journal, NULL},
#endif
};
const int reader_count = sizeof readers / sizeof *readers;

const reader *reader_find(const char *name)
{
    for (int i = 0; i < reader_count; i++)
        if (!strcmp(readers[i].name, name)) return &readers[i];
    return NULL;
}

bool reader_feed(const reader *r, const uint8_t *bytes, size_t size)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, r->file);
    FILE *f = fopen(path, "wb");
    if (!f || (r->before && fputs(r->before, f) < 0)) abort();
    if (fwrite(bytes, 1, size, f) != size || fclose(f)) abort();
    return r->read(path);
}
