"""Ways out of a child, as a submission would write them: each appends its name if it got through."""

ESCAPES = """
import os, sys, io
ctypes, socket, mmap = (sys.modules[name] for name in ("ctypes", "socket", "mmap"))
libc = ctypes.CDLL(None, use_errno=True)
through = []

def attempt(function):
    try:
        function()
    except (OSError, RuntimeError, ImportError, ValueError, AttributeError):
        return
    through.append(function.__name__)

def checked(result):
    if result in (-1, ctypes.c_void_p(-1).value):
        raise OSError(ctypes.get_errno(), "refused")

@attempt
def open_to_read(): open("/etc/passwd")
@attempt
def open_to_write(): open("/tmp/escaped", "w")
@attempt
def open_own_memory(): open("/proc/self/mem", "r+b")
@attempt
def open_parents_memory(): open(f"/proc/{PARENT}/mem", "r+b")
@attempt
def open_parents_environment(): open(f"/proc/{PARENT}/environ")
@attempt
def list_a_folder(): os.listdir("/")
@attempt
def stat_a_file(): os.stat("/")
@attempt
def make_a_folder(): os.mkdir("/tmp/escaped")
@attempt
def remove_a_file(): os.unlink("/tmp/not-there")
@attempt
def change_the_folder(): os.chdir("/")
@attempt
def make_a_link(): os.symlink("/etc/passwd", "/tmp/escaped")
@attempt
def fork(): os.fork() or os._exit(0)
@attempt
def start_a_program(): os.posix_spawn("/bin/true", ["true"], {})
@attempt
def become_a_program(): os.execv("/bin/true", ["true"])
@attempt
def start_a_thread(): sys.modules["_thread"].start_new_thread(print, ()) if "_thread" in sys.modules else checked(-1)
@attempt
def start_a_shell(): checked(-1 if os.system("true") else 0)
@attempt
def signal_the_parent(): os.kill(PARENT, 0)
@attempt
def signal_the_group(): os.killpg(0, 0)
@attempt
def open_a_socket(): socket.socket(socket.AF_INET, socket.SOCK_STREAM)
@attempt
def open_a_local_socket(): socket.socketpair()
@attempt
def look_a_name_up(): socket.create_connection(("localhost", 1))
@attempt
def pass_a_descriptor(): socket.socket(fileno=3).sendmsg([b"x"], [(1, 1, bytes(4))])
@attempt
def copy_a_descriptor(): os.dup(3)
@attempt
def close_the_channel(): os.close(3)
@attempt
def make_a_pipe(): os.pipe()
@attempt
def make_a_file_in_memory(): os.memfd_create("x")
@attempt
def read_the_output(): os.read(1, 1)
@attempt
def write_to_another(): os.write(4, b"x")
@attempt
def be_nicer(): os.nice(1)
@attempt
def change_the_user(): os.setuid(65534)
@attempt
def make_a_session(): os.setsid()
@attempt
def ask_for_the_machine(): os.uname()
@attempt
def raise_a_limit(): sys.modules["resource"].setrlimit(7, (16, 16))
@attempt
def map_executable_memory():
    libc.mmap.restype = ctypes.c_void_p
    checked(libc.mmap(None, ctypes.c_size_t(4096), 7, 0x22, -1, ctypes.c_long(0)))
@attempt
def make_memory_executable():
    pages = mmap.mmap(-1, 4096)
    address = ctypes.addressof(ctypes.c_char.from_buffer(pages))
    checked(libc.mprotect(ctypes.c_void_p(address), ctypes.c_size_t(4096), 5))
@attempt
def write_through_ctypes(): checked(libc.open(b"/tmp/escaped", 0o101, 0o644))

def f(x, graph):
    if through:
        raise ValueError(" ".join(through))
    return x
"""

# Every system call by its number, with arguments that do nothing; what is not refused with EPERM got through.
# Of x86-64 not the two for probes, which the kernel hides from every filter and which end the process.
EVERY_CALL = """
import sys
ctypes = sys.modules["ctypes"]
libc = ctypes.CDLL(None, use_errno=True)
def f(x, graph):
    through = []
    for number in range(600):
        if number not in ALLOWED and number not in (335, 336):
            ctypes.set_errno(0)
            if libc.syscall(ctypes.c_long(number), *[ctypes.c_long(0)] * 6) != -1 or ctypes.get_errno() != 1:
                through.append(number)
    return through
"""
