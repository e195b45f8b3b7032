// SPDX-License-Identifier: MIT
//
// Messages for publishers and operators, to protobuf and back; the others are in messages.cpp, which knows
// how any of them becomes a frame.
#pragma once

#include "common/net/messages.h"

namespace selvage::wire {
class Publish;
class PublishReady;
class PublishProgress;
class Published;
class Unpublish;
class StatusReport;
}  // namespace selvage::wire

namespace selvage {

wire::Publish to_wire(const Publish& message);
wire::PublishReady to_wire(const PublishReady& message);
wire::PublishProgress to_wire(const PublishProgress& message);
wire::Published to_wire(const Published& message);
wire::Unpublish to_wire(const Unpublish& message);
wire::StatusReport to_wire(const StatusReport& message);

/// Fail with Protocol, naming the field.
Result<Publish> from_wire(const wire::Publish& in);
Result<PublishReady> from_wire(const wire::PublishReady& in);
Result<PublishProgress> from_wire(const wire::PublishProgress& in);
Result<Published> from_wire(const wire::Published& in);
Result<Unpublish> from_wire(const wire::Unpublish& in);
Result<StatusReport> from_wire(const wire::StatusReport& in);

}  // namespace selvage
