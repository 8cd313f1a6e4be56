// SPDX-License-Identifier: MIT
// System calls of the tool's C library, implemented with node's functions. Each thread has its own instance; file
// descriptors are those of the system, so that threads share them. Errors are negative numbers, as in WASI.
import * as fs from "node:fs";
import { createRequire } from "node:module";
import * as os from "node:os";
import { isatty } from "node:tty";
import { allowed } from "./inside.js";
import { systemPath, toolPath } from "./paths.js";

/** Loaded on first use, because loading takes 10 ms. */
const randomBytes = (count) => createRequire(import.meta.url)("node:crypto").randomBytes(count);
const onWindows = process.platform === "win32";
const errors = new Map(
  ("SUCCESS 2BIG ACCES ADDRINUSE ADDRNOTAVAIL AFNOSUPPORT AGAIN ALREADY BADF BADMSG BUSY CANCELED CHILD CONNABORTED CONNREFUSED " +
    "CONNRESET DEADLK DESTADDRREQ DOM DQUOT EXIST FAULT FBIG HOSTUNREACH IDRM ILSEQ INPROGRESS INTR INVAL IO ISCONN ISDIR LOOP MFILE " +
    "MLINK MSGSIZE MULTIHOP NAMETOOLONG NETDOWN NETRESET NETUNREACH NFILE NOBUFS NODEV NOENT NOEXEC NOLCK NOLINK NOMEM NOMSG " +
    "NOPROTOOPT NOSPC NOSYS NOTCONN NOTDIR NOTEMPTY NOTRECOVERABLE NOTSOCK NOTSUP NOTTY NXIO OVERFLOW OWNERDEAD PERM PIPE PROTO " +
    "PROTONOSUPPORT PROTOTYPE RANGE ROFS SPIPE SRCH STALE TIMEDOUT TXTBSY XDEV").split(" ").map((name, number) => [`E${name}`, number]));
const errorOf = (error) => errors.get(error.code) ?? errors.get("EIO");
const failure = (name) => -errors.get(name);

const pause = new Int32Array(new SharedArrayBuffer(4));
export const sleep = (milliseconds) => Atomics.wait(pause, 0, 0, milliseconds);

/** Repeats a node function while a pipe is empty or full. */
function patiently(work) {
  for (;;) {
    try {
      return work();
    } catch (error) {
      if (error.code !== "EAGAIN") throw error;
      sleep(2);
    }
  }
}

// Flags of open() in the C library, and the corresponding flags of node.
const { constants } = fs;
const openFlags = [[1, constants.O_WRONLY], [2, constants.O_RDWR], [64, constants.O_CREAT], [128, constants.O_EXCL], [512, constants.O_TRUNC],
  [1024, constants.O_APPEND], [2048, constants.O_NONBLOCK], [131072, constants.O_NOFOLLOW]];
const directoryFlag = 65536;
const kinds = [["isFile", 8], ["isDirectory", 4], ["isSymbolicLink", 10], ["isFIFO", 1], ["isCharacterDevice", 2], ["isBlockDevice", 6], ["isSocket", 12]];
/** Maximum number of pages; the last page of 4 GB is unused, so that no end address is 2^32. */
export const mostPages = 65535;
const pageBytes = 65536;
/** Maximum number of bytes per read or write of node. */
const mostBytes = 2 ** 30;
const atCurrent = -100, noFollow = 0x100, removesFolder = 0x200;

/**
 * Returns the imports of one thread. memory: memory of the program; exports(): functions of this thread's instance;
 * program: path of the tool itself. Raises SIGPIPE (13) if the output pipe is closed.
 */
export function systemOf({ memory, exports, program }) {
  let bytes = new Uint8Array(memory.buffer), data = new DataView(memory.buffer);
  /** Updates the views so that they reach `end`: memory may have grown in another thread. */
  function see(end = 0) {
    if (end > bytes.length) memory.grow(0);
    if (bytes.buffer === memory.buffer) return;
    bytes = new Uint8Array(memory.buffer);
    data = new DataView(memory.buffer);
  }
  const u32 = (at) => (see(at + 4), data.getUint32(at, true));
  const set32 = (at, value) => (see(at + 4), data.setUint32(at, value, true));
  const set64 = (at, value) => (see(at + 8), data.setBigInt64(at, value, true));

  function grow(pages) {
    try {
      return memory.grow(pages) > 0;
    } catch {
      return false;
    }
  }

  function textBytes(at) {
    see(at + 1);
    return Buffer.from(bytes.slice(at, bytes.indexOf(0, at)));
  }
  /**
   * Returns the path at an address in the form that fs needs: text on Windows, bytes elsewhere. pathAt is for queries
   * only; all other functions use pathTo, which checks access.
   */
  const pathAt = (at) => (onWindows ? systemPath(textBytes(at >>> 0).toString()) : textBytes(at >>> 0));
  const pathTo = (at) => allowed(pathAt(at));
  /** Copies as much of a text as fits to an address; returns the number of bytes. */
  function give(at, size, text) {
    see(at + size);
    const part = text.subarray(0, size);
    bytes.set(part, at);
    return part.length;
  }

  /** Open files whose position this thread tracks, and open folders. */
  const files = new Map(), folders = new Map();
  let nextFolder = 1 << 20;
  const tried = (work) => (...values) => {
    see();
    try {
      return work(...values) ?? 0;
    } catch (error) {
      if (error.code === undefined) throw error;
      return -errorOf(error);
    }
  };
  /** WASI's functions return errors as positive numbers. */
  const wasi = (work) => (...values) => -tried(work)(...values);

  function open(at, flags, more) {
    const path = pathTo(at);
    if (flags & directoryFlag) {
      if (!fs.statSync(path).isDirectory()) return failure("ENOTDIR");
      // Windows cannot open folders.
      const number = onWindows ? nextFolder++ : fs.openSync(path, constants.O_RDONLY | constants.O_DIRECTORY);
      folders.set(number, { path });
      return number;
    }
    const mode = flags & 64 ? u32(more >>> 0) : 0;
    const given = openFlags.reduce((sum, [bit, its]) => (flags & bit ? sum | (its ?? 0) : sum), 0);
    const number = fs.openSync(path, given, mode);
    files.set(number, { at: 0n, moved: false });
    return number;
  }

  function close(number) {
    files.delete(number);
    const folder = folders.get(number);
    folders.delete(number);
    if (!(folder && onWindows)) fs.closeSync(number);
  }

  /**
   * Calls transfer(place, size, position) for each part, until one is incomplete. Writes the number of transferred
   * bytes to `result`.
   */
  function transferAll(number, parts, count, result, transfer) {
    const file = files.get(number);
    let total = 0;
    for (let i = 0; i < count; ++i) {
      const place = u32(parts + 8 * i), size = Math.min(u32(parts + 8 * i + 4), mostBytes);
      if (size === 0) continue;
      see(place + size);
      const moved = patiently(() => transfer(place, size, file?.moved ? file.at : null));
      if (file) file.at += BigInt(moved);
      total += moved;
      if (moved < size) break;
    }
    set32(result, total);
  }

  function read(number, parts, count, result) {
    transferAll(number, parts >>> 0, count, result >>> 0, (place, size, position) => {
      try {
        return fs.readSync(number, bytes, place, size, position);
      } catch (error) {
        if (error.code === "EOF") return 0; // a closed pipe on Windows
        throw error;
      }
    });
  }

  function write(number, parts, count, result) {
    try {
      transferAll(number, parts >>> 0, count, result >>> 0, (place, size, position) => fs.writeSync(number, bytes, place, size, position));
    } catch (error) {
      if (error.code === "EPIPE" || (onWindows && error.code === "EOF")) exports().raise(13);
      throw error;
    }
  }

  function readAt(number, parts, count, begin, result) {
    let total = 0;
    for (let i = 0; i < count; ++i) {
      const place = u32((parts >>> 0) + 8 * i), size = u32((parts >>> 0) + 8 * i + 4);
      see(place + size);
      const got = fs.readSync(number, bytes, place, size, begin + BigInt(total));
      total += got;
      if (got < size) break;
    }
    set32(result >>> 0, total);
  }

  /** Only files that this thread opened have a tracked position. */
  function seek(number, offset, whence, result) {
    const file = files.get(number);
    if (!file) return failure("ESPIPE");
    const stats = fs.fstatSync(number, { bigint: true });
    if (!stats.isFile()) return failure("ESPIPE");
    const at = [0n, file.at, stats.size][whence] + offset;
    if (at < 0n) return failure("EINVAL");
    if (at !== file.at) file.moved = true;
    file.at = at;
    set64(result >>> 0, at);
    return 0;
  }

  const wanted = { bigint: true, throwIfNoEntry: false };
  function setStatus(to, stats) {
    if (!stats) return failure("ENOENT");
    const at = to >>> 0;
    see(at + 88);
    bytes.fill(0, at, at + 88);
    set32(at, Number(stats.dev ^ (stats.dev >> 32n)) >>> 0);
    set32(at + 12, Number(stats.mode));
    set32(at + 16, Number(stats.nlink));
    set32(at + 20, Number(stats.uid));
    set32(at + 24, Number(stats.gid));
    set64(at + 40, stats.size);
    set32(at + 48, 4096);
    set32(at + 52, Number((stats.size + 511n) / 512n));
    [stats.atimeNs, stats.mtimeNs, stats.ctimeNs].forEach((time, i) => {
      set32(at + 56 + 8 * i, Number(time / 1000000000n));
      set32(at + 60 + 8 * i, Number(time % 1000000000n));
    });
    data.setBigUint64(at + 80, BigInt.asUintN(64, stats.ino), true);
    return 0;
  }

  /** Returns the path at an address; a relative path starts at an open folder. */
  function pathBelow(folder, at) {
    const path = pathAt(at);
    const from = folder === atCurrent ? undefined : folders.get(folder);
    if (!from || path.toString().startsWith("/")) return path;
    return onWindows ? `${from.path}\\${path}` : Buffer.concat([Buffer.from(from.path), Buffer.from("/"), path]);
  }

  /** Lists names in an open folder, as many as fit. */
  function list(number, to, size) {
    const folder = folders.get(number), entryBytes = 280, longest = 255;
    if (!folder) return failure("ENOTDIR");
    folder.entries ??= [".", "..", ...fs.readdirSync(folder.path, { withFileTypes: true, encoding: "buffer" })];
    folder.at ??= 0;
    let at = to >>> 0;
    const end = at + size;
    see(end);
    for (; folder.at < folder.entries.length && at + entryBytes <= end; ++folder.at, at += entryBytes) {
      const entry = folder.entries[folder.at];
      const name = Buffer.from(entry.name ?? entry);
      bytes.fill(0, at, at + entryBytes);
      set64(at, 1n); // 0 would denote a removed file
      set64(at + 8, BigInt(folder.at + 1));
      data.setUint16(at + 16, entryBytes, true);
      bytes[at + 18] = entry.name === undefined ? 4 : kinds.find(([is]) => entry[is]())?.[1] ?? 0;
      bytes.set(name.subarray(0, longest), at + 19);
    }
    return at - (to >>> 0);
  }

  /** The C library calls this for each path component, so a component that is not a link must not throw. */
  function readLink(at, to, size) {
    const path = pathAt(at);
    if (path.toString() === "/proc/self/exe") return give(to >>> 0, size, Buffer.from(onWindows ? toolPath(program) : program));
    const stats = fs.lstatSync(path, { throwIfNoEntry: false });
    if (!stats?.isSymbolicLink()) return failure(stats ? "EINVAL" : "ENOENT");
    const target = fs.readlinkSync(path, "buffer");
    return give(to >>> 0, size, onWindows ? Buffer.from(toolPath(target.toString())) : target);
  }

  function setTime(clock, to) {
    const time = clock === 0 ? BigInt(Math.round((performance.timeOrigin + performance.now()) * 1e6)) : process.hrtime.bigint();
    see();
    set32(to >>> 0, Number(time / 1000000000n));
    set32((to >>> 0) + 4, Number(time % 1000000000n));
    return 0;
  }

  const environment = Object.entries(process.env).map(([name, value]) => Buffer.from(`${name}=${value}\0`));

  const wasiImports = {
    fd_close: wasi(close),
    fd_read: wasi(read),
    fd_write: wasi(write),
    fd_pread: wasi(readAt),
    fd_seek: wasi(seek),
    fd_sync: wasi((number) => (folders.has(number) && onWindows ? 0 : fs.fsyncSync(number))),
    fd_fdstat_get: wasi((number, to) => {
      const terminal = isatty(number);
      if (!terminal) fs.fstatSync(number);
      see((to >>> 0) + 24);
      bytes.fill(0, to >>> 0, (to >>> 0) + 24);
      bytes[to >>> 0] = terminal ? 2 : 4;
      return 0;
    }),
    environ_sizes_get: wasi((count, size) => {
      set32(count >>> 0, environment.length);
      set32(size >>> 0, environment.reduce((sum, text) => sum + text.length, 0));
    }),
    environ_get: wasi((places, texts) => {
      let at = texts >>> 0;
      environment.forEach((text, i) => {
        set32((places >>> 0) + 4 * i, at);
        at += give(at, text.length, text);
      });
    }),
    clock_time_get: wasi((clock, _, to) => {
      set64(to >>> 0, clock === 0 ? BigInt(Math.round((performance.timeOrigin + performance.now()) * 1e6)) : process.hrtime.bigint());
    }),
  };

  const files64 = {
    __syscall_open: tried(open),
    __syscall_openat: tried((folder, at, flags, more) => (folder === atCurrent ? open(at, flags, more) : failure("ENOSYS"))),
    __syscall_stat64: tried((at, to) => setStatus(to, fs.statSync(pathAt(at), wanted))),
    __syscall_lstat64: tried((at, to) => setStatus(to, fs.lstatSync(pathAt(at), wanted))),
    __syscall_fstat64: tried((number, to) => setStatus(to, fs.fstatSync(number, { bigint: true }))),
    __syscall_fstatat64: tried((folder, at, to, flags) => {
      const path = pathBelow(folder, at);
      return setStatus(to, flags & noFollow ? fs.lstatSync(path, wanted) : fs.statSync(path, wanted));
    }),
    __syscall_getdents64: tried(list),
    __syscall_getcwd: tried((to, size) => {
      const path = Buffer.from(`${onWindows ? toolPath(process.cwd()) : process.cwd()}\0`);
      if (path.length > size) return failure("ERANGE");
      give(to >>> 0, size, path);
      return path.length;
    }),
    __syscall_readlink: tried(readLink),
    __syscall_unlink: tried((at) => fs.unlinkSync(pathTo(at))),
    __syscall_unlinkat: tried((folder, at, flags) =>
      (flags & removesFolder ? fs.rmdirSync(allowed(pathBelow(folder, at))) : fs.unlinkSync(allowed(pathBelow(folder, at))))),
    __syscall_rmdir: tried((at) => fs.rmdirSync(pathTo(at))),
    __syscall_rename: tried((from, to) => fs.renameSync(pathTo(from), pathTo(to))),
    __syscall_mkdir: tried((at, mode) => fs.mkdirSync(pathTo(at), mode)),
    __syscall_symlink: tried((target, at) => fs.symlinkSync(textBytes(target >>> 0), pathTo(at))),
    __syscall_chmod: tried((at, mode) => fs.chmodSync(pathTo(at), mode)),
    __syscall_fchmod: tried((number, mode) => fs.fchmodSync(number, mode)),
    __syscall_fchmodat: tried((folder, at, mode) => fs.chmodSync(allowed(pathBelow(folder, at)), mode)),
    __syscall_fchown32: tried((number, user, group) => fs.fchownSync(number, user, group)),
    __syscall_access: tried((at, mode) => fs.accessSync(pathAt(at), mode)),
    __syscall_ftruncate64: tried((number, low, high) => fs.ftruncateSync(number, (low >>> 0) + 2 ** 32 * (high >>> 0))),
    __syscall_truncate64: tried((at, low, high) => fs.truncateSync(pathTo(at), (low >>> 0) + 2 ** 32 * (high >>> 0))),
    makeLink: tried((from, to) => fs.linkSync(pathTo(from), pathTo(to))),
    // F_SETFD (2) and F_SETFL (4) need no action; 1: F_GETFD, 3: F_GETFL.
    __syscall_fcntl64: tried((number, command) => {
      if (command < 1 || command > 4) return failure("ENOSYS");
      if (!folders.has(number)) fs.fstatSync(number);
      return command === 3 ? 2 : 0;
    }),
    __syscall_ioctl: () => failure("ENOTTY"),
    __syscall_poll: (_, count, milliseconds) => {
      if (count === 0) sleep(milliseconds < 0 ? Infinity : milliseconds);
      return 0;
    },
    __syscall_chown32: tried((at, user, group) => fs.chownSync(pathTo(at), user, group)),
    // Starting processes and mapping files are not supported.
    __syscall_pipe: () => failure("ENOSYS"),
    __syscall_wait4: () => failure("ECHILD"),
    __syscall_mprotect: () => failure("ENOSYS"),
    _mmap_js: () => failure("ENOSYS"),
    _munmap_js: () => failure("ENOSYS"),
    posix_spawn: () => errors.get("ENOSYS"),
  };

  let second = 0; // the second value that longjmp passes on
  const others = {
    setTempRet0: (number) => (second = number),
    getTempRet0: () => second,
    memory,
    __clock_gettime: setTime,
    clock_gettime: setTime,
    emscripten_get_now: () => Number(process.hrtime.bigint()) / 1e6,
    emscripten_memcpy_big: (to, from, size) => {
      see(Math.max(to >>> 0, from >>> 0) + size);
      bytes.copyWithin(to >>> 0, from >>> 0, (from >>> 0) + size);
    },
    emscripten_get_heap_max: () => mostPages * pageBytes,
    emscripten_resize_heap: (size) => {
      const missing = Math.ceil(((size >>> 0) - memory.buffer.byteLength) / pageBytes), step = 256;
      // Grows in steps of 16 MB, because each step makes all threads update their views.
      return missing <= 0 || grow(Math.ceil(missing / step) * step) || grow(missing) ? 1 : 0;
    },
    emscripten_num_logical_cores: () => os.availableParallelism?.() ?? os.cpus().length,
    emscripten_check_blocking_allowed: () => {},
    emscripten_unwind_to_js_event_loop: () => {
      throw new Error("a thread exited unexpectedly");
    },
    processNumber: () => process.pid,
    userNumber: () => process.geteuid?.() ?? 0,
    hostName: (to, size) => give(to >>> 0, size, Buffer.from(`${os.hostname()}\0`)),
    fillRandom: (to, size) => give(to >>> 0, size, randomBytes(size)),
    sendSignal: (number, signal) => {
      try {
        process.kill(number, signal);
        return 0;
      } catch (error) {
        return error.code === "ESRCH" || error.code === "EPERM" ? -errorOf(error) : failure("EINVAL");
      }
    },
    abort: () => {
      throw new Error("the program called abort()");
    },
  };

  return { env: { ...files64, ...others }, wasi_snapshot_preview1: wasiImports };
}
