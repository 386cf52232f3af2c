#!/bin/sh
# SPDX-License-Identifier: MIT
# A test Slurm cluster on this machine: a controller and two nodes of one CPU each, all daemons of one
# machine (one node of two CPUs if this build of Slurm refuses several). Uses Debian's slurm-wlm and munge.
#
#   cluster.sh start DIR     writes everything but its sockets to DIR; prints "nodes 2" or "nodes 1"
#                            (then export SLURM_CONF=DIR/slurm.conf)
#   cluster.sh kill DIR N    kills node N (1 or 2) and its processes, like a lost machine
#   cluster.sh node DIR N    restarts node N
#   cluster.sh stop DIR
#
# Exit code 77: Slurm is not installed or cannot be started here (not root).
set -eu
PATH=$PATH:/usr/sbin:/sbin
what=$1
dir=$2
skip() { echo "cluster.sh: $1" >&2; exit 77; }

# Kills all processes by the daemons' pid files.
end() {
    for file in "$dir"/*.pid; do
        [ -e "$file" ] || continue
        number=$(cat "$file")
        kill -9 "$number" 2>/dev/null || true
        rm -f "$file"
    done
    if [ -e "$dir/spool" ]; then rm -rf "$(cat "$dir/spool")"; fi
}

configure() {  # $1: nodes
    if [ "$1" = 2 ]; then
        lines="NodeName=${name}1 NodeHostName=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 RealMemory=500
NodeName=${name}2 NodeHostName=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 RealMemory=500"
        names=${name}1,${name}2
    else
        lines="NodeName=${name}1 NodeHostName=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=2 RealMemory=500"
        names=${name}1
    fi
    cat > "$dir/slurm.conf" <<END
ClusterName=diptych
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$spool/munge.socket
SlurmctldPort=$port
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd-%n.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd-%n.log
StateSaveLocation=$dir/state
SlurmdSpoolDir=$spool/%n
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=1,sched_interval=2
MpiDefault=none
ReturnToService=2
SlurmdTimeout=5
SlurmctldTimeout=5
InactiveLimit=0
KillWait=2
MinJobAge=600
JobRequeue=1
JobCompType=jobcomp/none
AccountingStorageType=accounting_storage/none
$lines
PartitionName=all Nodes=$names Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
END
}

started() {  # waits until the controller sees $1 idle CPUs
    for _ in $(seq 100); do
        free=$(SLURM_CONF=$dir/slurm.conf sinfo -h -o %C 2>/dev/null | cut -d/ -f2)
        [ "$free" = "$1" ] && return 0
        sleep 0.2
    done
    return 1
}

case $what in
start)
    for program in munged slurmctld slurmd sbatch sinfo; do
        command -v $program >/dev/null || skip "$program is not installed (apt-get install slurm-wlm munge)"
    done
    [ "$(id -u)" = 0 ] || skip "Slurm's daemons need root"
    host=$(hostname -s)
    mkdir -p "$dir/state"
    chmod 755 "$dir"
    # Folder of sockets, whose paths may have at most 107 characters.
    spool=$(mktemp -d /tmp/slurm.XXXXXX)
    chmod 755 "$spool"
    echo "$spool" > "$dir/spool"
    port=$((20000 + $$ % 20000))
    name=diptych$port-
    echo "$name" > "$dir/name"
    dd if=/dev/urandom of="$dir/munge.key" bs=1024 count=1 2>/dev/null
    chmod 400 "$dir/munge.key"
    munged --force --key-file="$dir/munge.key" --socket="$spool/munge.socket" --pid-file="$dir/munged.pid" \
        --log-file="$dir/munged.log" --seed-file="$dir/munge.seed" || skip "munged does not start"
    for nodes in 2 1; do
        configure $nodes
        export SLURM_CONF="$dir/slurm.conf"
        # The daemons' output is redirected: a caller that waits for this script's output would wait for
        # them.
        slurmctld -c -f "$SLURM_CONF" >"$dir/start.log" 2>&1 </dev/null || skip "slurmctld does not start: $(tail -1 "$dir/start.log")"
        for n in $(seq $nodes); do
            slurmd -N $name$n -f "$SLURM_CONF" >>"$dir/start.log" 2>&1 </dev/null || true
        done
        if started 2; then
            echo "nodes $nodes"
            exit 0
        fi
        for file in "$dir"/slurm*.pid; do
            [ -e "$file" ] && kill -9 "$(cat "$file")" 2>/dev/null || true
            rm -f "$file"
        done
        rm -rf "$dir/state" && mkdir "$dir/state"
    done
    end
    skip "no node came up: $(tail -1 "$dir"/slurmd-*.log 2>/dev/null)"
    ;;
kill)
    node=$(cat "$dir/name")$3
    kill -9 "$(cat "$dir/slurmd-$node.pid")"
    rm -f "$dir/slurmd-$node.pid"
    # Processes on the node have its name in their environment; each job step has a daemon as its parent.
    for environ in /proc/[0-9]*/environ; do
        grep -qzx "SLURMD_NODENAME=$node" "$environ" 2>/dev/null || continue
        process=${environ#/proc/}
        process=${process%/environ}
        parent=$(cut -d' ' -f4 "/proc/$process/stat" 2>/dev/null || true)
        grep -qs slurmstepd "/proc/$parent/comm" && kill -9 "$parent" 2>/dev/null || true
        kill -9 "$process" 2>/dev/null || true
    done
    ;;
node)
    SLURM_CONF="$dir/slurm.conf" slurmd -N "$(cat "$dir/name")$3" -f "$dir/slurm.conf" >>"$dir/start.log" 2>&1 </dev/null
    ;;
stop)
    end
    ;;
*)
    echo "cluster.sh: $what: start, kill, node or stop" >&2
    exit 2
    ;;
esac
