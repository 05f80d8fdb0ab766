/* Nothing outside of the folder is read or written: by the kernel's own resolving, and step by step. */
#include <errno.h>
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "studio/server/folder.h"

typedef struct place {
    char top[64];
    tn_studio_folder *folder;
    bool walks;
} place;

static void write_text(const char *name, const char *text)
{
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

/* The process is in the folder's parent. */
static void set_up(place *p, bool walks, bool read_only)
{
    tn_error error;
    *p = (place){.top = "/tmp/tartan-folder-XXXXXX", .walks = walks};
    assert_non_null(mkdtemp(p->top));
    assert_int_equal(chdir(p->top), 0);
    assert_true(mkdir("in", 0777) == 0 && mkdir("in/deep", 0777) == 0 && mkdir("out", 0777) == 0);
    write_text("out/secret.plan", "secret");
    write_text("in/one.plan", "one");
    write_text("in/deep/two.plan", "two");
    assert_int_equal(symlink("one.plan", "in/link.plan"), 0);
    assert_int_equal(symlink("../one.plan", "in/deep/up.plan"), 0);
    assert_int_equal(symlink("deep", "in/folder"), 0);
    assert_int_equal(symlink("../out", "in/away"), 0);
    assert_int_equal(symlink("../out/secret.plan", "in/leak.plan"), 0);
    assert_int_equal(symlink("/etc/passwd", "in/root.plan"), 0);
    assert_int_equal(symlink("/proc/self/cwd/out/secret.plan", "in/magic.plan"), 0);
    assert_int_equal(symlink("self.plan", "in/self.plan"), 0);
    assert_int_equal(mkfifo("in/pipe.plan", 0666), 0);
    assert_int_equal(tn_studio_folder_open("in", read_only, &p->folder, &error), TN_OK);
    if (walks)
        tn_studio_folder_walk(p->folder);
}

static void tear_down(place *p)
{
    char command[128];
    tn_studio_folder_close(p->folder);
    assert_int_equal(chdir("/"), 0);
    snprintf(command, sizeof command, "rm -rf %s", p->top);
    assert_int_equal(system(command), 0);
}

static bool reads(const place *p, const char *name, const char *wanted)
{
    uint8_t *bytes;
    size_t size;
    tn_error error;
    if (tn_studio_folder_read(p->folder, name, 100, &bytes, &size, &error) != TN_OK) {
        assert_true(error.message[0] && (error.code == E_CANNOT_READ || error.code == E_FILE_TOO_LARGE));
        return false;
    }
    assert_string_equal((const char *)bytes, wanted);
    assert_int_equal(size, strlen(wanted));
    free(bytes);
    return true;
}

static void reads_what_is_below(place *p)
{
    assert_true(reads(p, "one.plan", "one") && reads(p, "deep/two.plan", "two"));
    assert_true(reads(p, "deep/../one.plan", "one") && reads(p, "./deep/./two.plan", "two"));
    /* links inside are followed where the kernel resolves them */
    assert_int_equal(reads(p, "link.plan", "one"), !p->walks);
    assert_int_equal(reads(p, "deep/up.plan", "one"), !p->walks);
    assert_int_equal(reads(p, "folder/two.plan", "two"), !p->walks);
}

static void reads_nothing_else(place *p)
{
    const char *names[] = {"../out/secret.plan",
                           "deep/../../out/secret.plan",
                           "/etc/passwd",
                           "away/secret.plan",
                           "leak.plan",
                           "root.plan",
                           "magic.plan",
                           "self.plan",
                           "pipe.plan",
                           "deep",
                           ".",
                           "..",
                           "",
                           "nothing.plan",
                           "one.plan/",
                           "one.plan/two.plan",
                           "deep/../../in/one.plan",
                           "//etc/passwd",
                           "/dev/null"};
    char long_name[9000];
    memset(long_name, 'a', sizeof long_name - 1);
    long_name[sizeof long_name - 1] = '\0';
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (reads(p, names[i], "secret"))
            fail_msg("%s is read", names[i]);
    assert_false(reads(p, long_name, ""));
    write_text("in/large.plan",
               "0123456789012345678901234567890123456789012345678901234567890123456789012345678901234567890123456789.");
    assert_false(reads(p, "large.plan", ""));
}

static bool writes(const place *p, const char *name, const char *text, const char *seen, bool *conflict)
{
    tn_error error;
    tn_file_hash now, last = seen[0] ? tn_hash_of_bytes(seen, strlen(seen)) : (tn_file_hash){""};
    return tn_studio_folder_write(p->folder, name, text, strlen(text), &last, &now, conflict, &error) == TN_OK;
}

static void writes_what_is_below(place *p)
{
    bool conflict;
    assert_true(writes(p, "one.plan", "first", "one", &conflict) && !conflict && reads(p, "one.plan", "first"));
    assert_true(writes(p, "one.plan", "second", "one", &conflict) && conflict && reads(p, "one.plan", "first"));
    assert_true(writes(p, "one.plan", "second", "", &conflict) && conflict && reads(p, "one.plan", "first"));
    assert_true(writes(p, "deep/new.plan", "new", "", &conflict) && !conflict && reads(p, "deep/new.plan", "new"));
    assert_true(writes(p, "lost.plan", "new", "old", &conflict) && conflict);
    assert_true(writes(p, "empty.plan", "", "", &conflict) && !conflict && reads(p, "empty.plan", ""));
    assert_int_equal(access("in/lost.plan", F_OK), -1);
}

static void writes_nothing_else(place *p)
{
    bool conflict;
    const char *names[] = {"../out/new.plan",
                           "away/new.plan",
                           "away/secret.plan",
                           "leak.plan",
                           "link.plan",
                           "root.plan",
                           "magic.plan",
                           "pipe.plan",
                           "deep",
                           ".",
                           "",
                           "/tmp/new.plan",
                           "deep/../new.plan",
                           "notes.txt",
                           "none/new.plan",
                           "one.plan/new.plan"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (writes(p, names[i], "new", "", &conflict) && !conflict)
            fail_msg("%s is written", names[i]);
    assert_int_equal(access("out/new.plan", F_OK), -1);
    struct stat link;
    assert_true(lstat("in/link.plan", &link) == 0 && S_ISLNK(link.st_mode));
}

static void lists_rule_files(place *p)
{
    tn_studio_files list;
    tn_error error;
    assert_int_equal(mkdir("in/.hidden", 0777), 0);
    assert_int_equal(mkdir("in/node_modules", 0777), 0);
    write_text("in/.hidden/three.plan", "");
    write_text("in/node_modules/four.plan", "");
    write_text("in/notes.txt", "");
    assert_int_equal(tn_studio_folder_list(p->folder, &list, &error), TN_OK);
    const char *known[] = {"deep/two.plan", "deep/up.plan", "link.plan", "one.plan"},
               *walked[] = {"deep/two.plan", "one.plan"};
    const char **wanted = p->walks ? walked : known;
    assert_int_equal(list.count, p->walks ? 2 : 4);
    for (size_t i = 0; i < list.count; i++) {
        assert_string_equal(list.files[i].name, wanted[i]);
        assert_int_equal(list.files[i].size, 3);
        assert_string_equal(list.files[i].notation, "plan");
    }
    assert_false(list.cut);
    tn_studio_files_clear(&list);
}

static void notices_changes(place *p)
{
    tn_file_stamp none = tn_studio_folder_stamp(p->folder, "new.plan"),
                  out = tn_studio_folder_stamp(p->folder, "leak.plan");
    assert_true(none.file == 0 && out.file == 0 && !tn_studio_folder_hash(p->folder, "leak.plan").text[0]);
    write_text("in/new.plan", "a");
    tn_file_stamp one = tn_studio_folder_stamp(p->folder, "new.plan");
    tn_file_hash hash = tn_studio_folder_hash(p->folder, "new.plan");
    write_text("in/new.plan", "longer");
    tn_file_stamp other = tn_studio_folder_stamp(p->folder, "new.plan");
    assert_memory_not_equal(&one, &other, sizeof one);
    assert_string_not_equal(hash.text, tn_studio_folder_hash(p->folder, "new.plan").text);
    assert_string_equal(hash.text, tn_hash_of_bytes("a", 1).text);
}

static void in_both_ways(void (*check)(place *p))
{
    for (int walks = 0; walks < 2; walks++) {
        place p;
        set_up(&p, walks, false);
        check(&p);
        tear_down(&p);
    }
}

static void reading(void **state)
{
    (void)state;
    in_both_ways(reads_what_is_below);
    in_both_ways(reads_nothing_else);
}

static void writing(void **state)
{
    (void)state;
    in_both_ways(writes_what_is_below);
    in_both_ways(writes_nothing_else);
}

static void looking(void **state)
{
    (void)state;
    in_both_ways(lists_rule_files);
    in_both_ways(notices_changes);
}

static void read_only(void **state)
{
    (void)state;
    place p;
    bool conflict;
    set_up(&p, false, true);
    assert_true(tn_studio_folder_read_only(p.folder) && reads(&p, "one.plan", "one"));
    assert_false(writes(&p, "one.plan", "first", "one", &conflict) || writes(&p, "new.plan", "new", "", &conflict));
    tear_down(&p);
}

static void folders_that_are_not_there(void **state)
{
    (void)state;
    tn_studio_folder *folder;
    tn_studio_files list;
    tn_error error;
    assert_int_equal(tn_studio_folder_open("/nowhere/at/all", false, &folder, &error), TN_IO);
    assert_null(folder);
    place p;
    set_up(&p, false, false);
    assert_int_equal(system("rm -rf in"), 0);
    assert_int_equal(tn_studio_folder_list(p.folder, &list, &error), TN_IO);
    assert_non_null(strstr(error.message, "is gone"));
    tn_studio_files_clear(&list);
    assert_false(reads(&p, "one.plan", "one"));
    tear_down(&p);
}

/* As those ask who compile. */
static void serves(void **state)
{
    (void)state;
    place p;
    uint8_t *bytes;
    size_t size, count;
    char **paths;
    bool cut_off;
    tn_error error;
    set_up(&p, false, false);
    tn_served served = tn_studio_folder_served(p.folder);
    assert_int_equal(served.read(served.context, "/deep/two.plan", &bytes, &size, &error), TN_OK);
    assert_string_equal((const char *)bytes, "two");
    free(bytes);
    assert_int_equal(served.read(served.context, "/../out/secret.plan", &bytes, &size, &error), TN_IO);
    assert_int_equal(served.read(served.context, "//etc/passwd", &bytes, &size, &error), TN_IO);
    assert_int_equal(served.list(served.context, &paths, &count, &cut_off, &error), TN_OK);
    assert_int_equal(count, 4);
    assert_string_equal(paths[0], "/deep/two.plan");
    while (count > 0)
        free(paths[--count]);
    free(paths);
    tear_down(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(reading),
                                       cmocka_unit_test(writing),
                                       cmocka_unit_test(looking),
                                       cmocka_unit_test(read_only),
                                       cmocka_unit_test(folders_that_are_not_there),
                                       cmocka_unit_test(serves)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
